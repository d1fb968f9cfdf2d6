// SPDX-License-Identifier: Apache-2.0
#include "tyndall/loader/parser.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "tyndall/integrators/nearest_name.h"
#include "tyndall/loader/directives.h"
#include "tyndall/loader/numbers.h"
#include "tyndall/loader/scene_builder.h"

namespace tyndall::loader {
namespace {

bool looks_like_directive(const Token& token) {
  return token.kind == TokenKind::word && 'A' <= token.text[0] && token.text[0] <= 'Z';
}

std::string description(const Token& token) {
  switch (token.kind) {
    case TokenKind::end:
      return "the file ends";
    case TokenKind::open_bracket:
      return "got \"[\"";
    case TokenKind::close_bracket:
      return "got \"]\"";
    case TokenKind::string:
      return "got a string";
    case TokenKind::word:
      return fmt::format("got \"{}\"", token.text.substr(0, 40));
  }
  return {};
}

}  // namespace

void Parser::run(uint32_t source) {
  inputs_.push_back({Tokenizer(source, *sources_[source].text), false});
  while (!inputs_.empty()) {
    try {
      step();
    } catch (const Failure& failure) {
      reporter_.error(failure.where, failure.message);
      recover();
    }
  }
}

void Parser::step() {
  directive_ = tokenizer().next();
  if (directive_.kind == TokenKind::end) return end_input();
  if (directive_.kind != TokenKind::word) fail_at(directive_, "a directive");
  const Directive* known = find_directive(directive_.text);
  if (!known)
    fail(directive_.where,
         fmt::format("unknown directive \"{}\"{}", directive_.text.substr(0, 40),
                     did_you_mean(directive_.text, directive_names())));
  builder_.enter(known->phase, directive_);
  known->read(*this, builder_);
}

void Parser::end_input() {
  const bool is_import = inputs_.back().is_import;
  inputs_.pop_back();
  if (is_import) builder_.end_import();
}

// Skips to what may be the next directive.
void Parser::recover() {
  for (;;) {
    try {
      const Token token = tokenizer().peek();
      if (token.kind == TokenKind::end || looks_like_directive(token)) return;
      tokenizer().next();
    } catch (const Failure&) {  // a broken string: skipped like everything else
    }
  }
}

void Parser::fail_at(const Token& token, std::string_view expected) {
  if (looks_like_directive(token)) tokenizer().rewind(token);  // recover() goes on with it
  fail(token.where,
       fmt::format("expected {}, {}{}", expected,
                   token.kind == TokenKind::end ? "but " : "", description(token)));
}

double Parser::number() {
  const Token token = tokenizer().next();
  double value = 0;
  if (token.kind != TokenKind::word ||
      parse_number(token.text, value) == NumberError::malformed)
    fail_at(token, "a number");
  if (parse_number(token.text, value) == NumberError::too_large)
    fail(token.where, fmt::format("the number {} is too large", token.text.substr(0, 40)));
  return value;
}

void Parser::read_numbers(double* values, size_t count) {
  const bool has_brackets = tokenizer().peek().kind == TokenKind::open_bracket;
  if (has_brackets) tokenizer().next();
  std::generate_n(values, count, [this] { return number(); });
  if (!has_brackets) return;
  const Token token = tokenizer().next();
  if (token.kind != TokenKind::close_bracket)
    fail_at(token, fmt::format("\"]\" after {} numbers", count));
}

std::string Parser::string(std::string_view what) {
  const Token token = tokenizer().next();
  if (token.kind != TokenKind::string) fail_at(token, fmt::format("{} in quotes", what));
  directive_.where.end = token.where.end;
  builder_.set_directive(directive_.where);
  return unescape(token);
}

std::optional<std::string> Parser::optional_string() {
  if (tokenizer().peek().kind != TokenKind::string) return std::nullopt;
  return unescape(tokenizer().next());
}

std::string Parser::value() {
  const Token token = tokenizer().next();
  if (token.kind != TokenKind::word && token.kind != TokenKind::string)
    fail_at(token, "a value");
  return token.kind == TokenKind::string ? unescape(token) : std::string(token.text);
}

void Parser::include(const std::string& name, Span where, bool is_import) {
  const int depth = sources_[where.source].depth + 1;
  if (depth > max_depth)
    fail(where,
         fmt::format("files include each other more than {} deep; does one include itself?",
                     max_depth));
  if (sources_.size() >= max_files)
    fail(where, fmt::format("more than {} files are included", max_files));
  const std::string path = files_.find(name, where);
  const uint32_t source = sources_.add({path, text_of(path, where), where, depth});
  if (is_import) builder_.begin_import();
  inputs_.push_back({Tokenizer(source, *sources_[source].text), is_import});
}

std::shared_ptr<const std::string> Parser::text_of(const std::string& path, Span where) {
  std::shared_ptr<const std::string>& text = texts_[path];
  if (text) return text;
  try {
    text = std::make_shared<const std::string>(read_text(path));
  } catch (const std::runtime_error& error) {
    fail(where, fmt::format("cannot read \"{}\": {}", path, error.what()));
  }
  return text;
}

}  // namespace tyndall::loader
