// SPDX-License-Identifier: Apache-2.0
#include "tyndall/loader/tokenizer.h"

#include <array>

#include "tyndall/loader/reporter.h"

namespace tyndall::loader {
namespace {

enum class CharClass : unsigned char { other, blank, delimiter };

constexpr std::array<CharClass, 256> char_classes = [] {
  std::array<CharClass, 256> classes{};
  for (const char c : {' ', '\t', '\r', '\n'})
    classes[static_cast<unsigned char>(c)] = CharClass::blank;
  for (const char c : {'"', '[', ']'})
    classes[static_cast<unsigned char>(c)] = CharClass::delimiter;
  return classes;
}();

CharClass class_of(char c) { return char_classes[static_cast<unsigned char>(c)]; }

// Zero if there is no such escape.
char escaped(char c) {
  switch (c) {
    case 'b':
      return '\b';
    case 'f':
      return '\f';
    case 'n':
      return '\n';
    case 'r':
      return '\r';
    case 't':
      return '\t';
    case '\\':
      return '\\';
    case '\'':
      return '\'';
    case '"':
      return '"';
    default:
      return 0;
  }
}

}  // namespace

Token Tokenizer::make(TokenKind kind, size_t begin, size_t end) const {
  return {kind,
          text_.substr(begin, end - begin),
          {source_, static_cast<uint32_t>(begin), static_cast<uint32_t>(end)}};
}

void Tokenizer::skip_blanks() {
  for (; at_ < text_.size(); ++at_) {
    if (text_[at_] == '#')
      at_ = std::min(text_.find('\n', at_), text_.size() - 1);
    else if (class_of(text_[at_]) != CharClass::blank)
      return;
  }
}

Token Tokenizer::string() {
  const size_t begin = at_;
  for (++at_; at_ < text_.size() && text_[at_] != '\n'; ++at_) {
    if (text_[at_] == '\\' && at_ + 1 < text_.size() && text_[at_ + 1] != '\n') {
      ++at_;
    } else if (text_[at_] == '"') {
      Token token = make(TokenKind::string, begin, ++at_);
      token.text = token.text.substr(1, token.text.size() - 2);
      return token;
    }
  }
  const size_t line_end = at_ > begin + 1 && text_[at_ - 1] == '\r' ? at_ - 1 : at_;
  fail(make(TokenKind::string, begin, line_end).where,
       "this string has no closing quote on its line");
}

Token Tokenizer::word() {
  const size_t begin = at_;
  while (at_ < text_.size() && class_of(text_[at_]) == CharClass::other) ++at_;
  return make(TokenKind::word, begin, at_);
}

Token Tokenizer::next() {
  skip_blanks();
  if (at_ >= text_.size()) return make(TokenKind::end, text_.size(), text_.size());
  switch (text_[at_]) {
    case '"':
      return string();
    case '[':
      ++at_;
      return make(TokenKind::open_bracket, at_ - 1, at_);
    case ']':
      ++at_;
      return make(TokenKind::close_bracket, at_ - 1, at_);
    default:
      return word();
  }
}

Token Tokenizer::peek() {
  const size_t at = at_;
  const Token token = next();
  at_ = at;
  return token;
}

std::string unescape(const Token& token) {
  std::string result;
  for (size_t i = 0; i < token.text.size(); ++i) {
    if (token.text[i] != '\\') {
      result += token.text[i];
      continue;
    }
    const char c = ++i < token.text.size() ? escaped(token.text[i]) : '\0';
    if (c == 0) fail(token.where, "unknown escape in a string; write \\\\ for a backslash");
    result += c;
  }
  return result;
}

}  // namespace tyndall::loader
