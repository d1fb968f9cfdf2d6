// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tyndall/loader/diagnostics.h"

namespace tyndall::loader {

/// A stretch of a source text [bytes], `end` exclusive.
struct Span {
  uint32_t source = 0;
  uint32_t begin = 0, end = 0;
};

/// The span from the start of `a` to the end of `b`; both in one source.
constexpr Span join(Span a, Span b) { return {a.source, a.begin, b.end}; }

/// The text of a scene file, as often as it is included.
struct SourceText {
  std::string name;
  std::shared_ptr<const std::string> text;
  std::optional<Span> included_at;  ///< the directive that named it
  int depth = 0;                    ///< of inclusion; the scene file itself is 0
};

/// All texts of a scene. Turns byte offsets into lines and columns when a message needs
/// them.
class SourceLibrary {
 public:
  /// Returns the new source's number, for Span::source. Precondition: less than 4 GiB of
  /// text.
  uint32_t add(SourceText source);
  const SourceText& operator[](uint32_t source) const { return sources_[source].source; }
  size_t size() const { return sources_.size(); }

  /// Line and column count from one, columns in bytes.
  SourceLocation locate(Span span) const;
  /// Whether `a` is read before `b`: included files stand where they are included.
  bool is_before(Span a, Span b) const;
  /// The line on which the span starts, without its end.
  std::string_view line(Span span) const;

 private:
  struct Indexed {
    SourceText source;
    mutable std::vector<uint32_t> line_starts;  // filled by the first question
  };
  const std::vector<uint32_t>& line_starts(uint32_t source) const;
  std::vector<uint32_t> offsets_from_root(Span span) const;
  size_t line_index(Span span) const;

  std::deque<Indexed> sources_;
};

}  // namespace tyndall::loader
