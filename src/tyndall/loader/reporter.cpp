// SPDX-License-Identifier: Apache-2.0
#include "tyndall/loader/reporter.h"

#include <fmt/format.h>

#include <algorithm>

#include "tyndall/loader/excerpt.h"

namespace tyndall::loader {

// The chain of files that a text was included by; only its ends if it is long.
std::string Reporter::inclusion_notes(uint32_t source) const {
  constexpr int shown_from_start = 4;
  std::string notes;
  int depth = sources_[source].depth;
  const int first_hidden = depth - shown_from_start;
  for (auto from = sources_[source].included_at; from; --depth) {
    const SourceLocation place = sources_.locate(*from);
    if (depth > first_hidden || depth == 1)
      notes += fmt::format("\n{}:{}:{}: note: included from here", place.file, place.line,
                           place.column);
    else if (depth == first_hidden)
      notes += fmt::format("\nnote: included through {} more files", first_hidden - 1);
    from = sources_[from->source].included_at;
  }
  return notes;
}

Diagnostic Reporter::diagnostic(Severity severity, Span where, std::string message) const {
  const SourceLocation at = sources_.locate(where);
  message = printable(message);
  std::string text =
      fmt::format("{}:{}:{}: {}: {}\n{}", at.file, at.line, at.column,
                  severity == Severity::error ? "error" : "warning", message,
                  excerpt(sources_.line(where), at.line, static_cast<size_t>(at.column - 1),
                          where.end - where.begin));
  text += inclusion_notes(where.source);
  return {severity, at, std::move(message), std::move(text)};
}

void Reporter::error(Span where, std::string message) {
  errors_.emplace_back(where, diagnostic(Severity::error, where, std::move(message)));
  if (errors_.size() >= max_errors) throw_if_errors();
}

void Reporter::warning(Span where, std::string message) {
  const int count = ++warned_[message];
  if (count > max_alike) return;
  if (count == max_alike) message += " (the last time that this is said)";
  warnings_.push_back(diagnostic(Severity::warning, where, std::move(message)));
  if (options_.on_warning) options_.on_warning(warnings_.back());
}

void Reporter::unsupported(Span where, std::string message) {
  if (options_.strict)
    error(where, std::move(message));
  else
    warning(where, std::move(message));
}

void Reporter::throw_if_errors() const {
  if (!has_errors()) return;
  auto ordered = errors_;
  std::stable_sort(ordered.begin(), ordered.end(), [this](const auto& a, const auto& b) {
    return sources_.is_before(a.first, b.first);
  });
  std::vector<Diagnostic> diagnostics;
  diagnostics.reserve(ordered.size());
  for (auto& [where, error] : ordered) diagnostics.push_back(std::move(error));
  throw SceneError(std::move(diagnostics));
}

}  // namespace tyndall::loader
