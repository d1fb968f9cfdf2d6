// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "tyndall/loader/source_library.h"

namespace tyndall::loader {

enum class TokenKind { word, string, open_bracket, close_bracket, end };

/// `text` of a string is what stands between its quotes, escapes not yet resolved.
struct Token {
  TokenKind kind;
  std::string_view text;
  Span where;  ///< quotes included
};

/// Cuts a scene file's text into tokens, as pbrt-v4 does: white space, double quotes and
/// square brackets separate, # at the start of a token begins a comment.
class Tokenizer {
 public:
  /// `text` must outlive the tokenizer and its tokens.
  Tokenizer(uint32_t source, std::string_view text) : source_(source), text_(text) {}

  /// Throws Failure for a string that does not end on its line.
  Token next();
  /// The token that next() will return.
  Token peek();
  /// next() will return `token` again.
  void rewind(const Token& token) { at_ = token.where.begin; }

 private:
  void skip_blanks();
  Token string();
  Token word();
  Token make(TokenKind kind, size_t begin, size_t end) const;

  uint32_t source_;
  std::string_view text_;
  size_t at_ = 0;
};

/// The string meant by a string token. Throws Failure for an unknown escape.
std::string unescape(const Token& token);

}  // namespace tyndall::loader
