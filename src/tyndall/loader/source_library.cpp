// SPDX-License-Identifier: Apache-2.0
#include "tyndall/loader/source_library.h"

#include <algorithm>
#include <utility>

namespace tyndall::loader {

uint32_t SourceLibrary::add(SourceText source) {
  sources_.push_back({std::move(source), {}});
  return static_cast<uint32_t>(sources_.size() - 1);
}

const std::vector<uint32_t>& SourceLibrary::line_starts(uint32_t source) const {
  const Indexed& indexed = sources_[source];
  if (indexed.line_starts.empty()) {
    const std::string& text = *indexed.source.text;
    indexed.line_starts.push_back(0);
    for (size_t i = text.find('\n'); i != std::string::npos; i = text.find('\n', i + 1))
      indexed.line_starts.push_back(static_cast<uint32_t>(i + 1));
  }
  return indexed.line_starts;
}

size_t SourceLibrary::line_index(Span span) const {
  const std::vector<uint32_t>& starts = line_starts(span.source);
  return static_cast<size_t>(std::upper_bound(starts.begin(), starts.end(), span.begin) -
                             starts.begin()) -
         1;
}

SourceLocation SourceLibrary::locate(Span span) const {
  const size_t line = line_index(span);
  const uint32_t start = line_starts(span.source)[line];
  return {.file = sources_[span.source].source.name,
          .line = static_cast<int>(line + 1),
          .column = static_cast<int>(span.begin - start + 1)};
}

// Where the span starts, after the inclusions on the way to it, the outermost first.
std::vector<uint32_t> SourceLibrary::offsets_from_root(Span span) const {
  std::vector<uint32_t> offsets;
  for (std::optional<Span> at = span; at; at = sources_[at->source].source.included_at)
    offsets.push_back(at->begin);
  std::reverse(offsets.begin(), offsets.end());
  return offsets;
}

bool SourceLibrary::is_before(Span a, Span b) const {
  return offsets_from_root(a) < offsets_from_root(b);
}

std::string_view SourceLibrary::line(Span span) const {
  const std::string_view text = *sources_[span.source].source.text;
  const std::string_view rest = text.substr(line_starts(span.source)[line_index(span)]);
  const std::string_view line = rest.substr(0, rest.find('\n'));
  return line.ends_with('\r') ? line.substr(0, line.size() - 1) : line;
}

}  // namespace tyndall::loader
