// SPDX-License-Identifier: Apache-2.0
#include "tyndall/loader/excerpt.h"

#include <fmt/core.h>

#include <algorithm>

namespace tyndall::loader {
namespace {

constexpr size_t max_width = 100;  // bytes of a line that are shown
constexpr size_t lead = 40;        // of them before the caret, if the line is cut

bool is_continuation(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

// Bytes in the UTF-8 sequence at the start of `text`; zero if there is no valid one.
size_t sequence_length(std::string_view text) {
  const auto first = static_cast<unsigned char>(text[0]);
  const size_t length = first < 0x80   ? 1
                        : first < 0xC2 ? 0
                        : first < 0xE0 ? 2
                        : first < 0xF0 ? 3
                        : first < 0xF5 ? 4
                                       : 0;
  if (length > text.size()) return 0;
  for (size_t i = 1; i < length; ++i)
    if (!is_continuation(text[i])) return 0;
  return length;
}

size_t columns(std::string_view printable_text) {
  return static_cast<size_t>(std::count_if(printable_text.begin(), printable_text.end(),
                                           [](char c) { return !is_continuation(c); }));
}

}  // namespace

std::string printable(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const size_t length = sequence_length(text);
    const bool is_control = length == 1 && (text[0] < ' ' || text[0] == 0x7F);
    if (text[0] == '\t')
      result += ' ';
    else if (length == 0 || is_control)
      result += '?';
    else
      result += text.substr(0, length);
    text.remove_prefix(std::max<size_t>(length, 1));
  }
  return result;
}

std::string excerpt(std::string_view line, int line_number, size_t begin, size_t length) {
  begin = std::min(begin, line.size());
  const size_t first = line.size() > max_width && begin > lead ? begin - lead : 0;
  const size_t last = std::min(line.size(), first + max_width);
  const size_t end = std::min(begin + std::min(length, line.size()), last);

  const std::string before =
      (first > 0 ? "..." : "") + printable(line.substr(first, begin - first));
  const std::string meant = printable(line.substr(begin, end - begin));
  const std::string after = printable(line.substr(end, last - end));
  const size_t tildes = std::max<size_t>(columns(meant), 1) - 1;
  return fmt::format("{:5} | {}{}{}{}\n      | {}^{}", line_number, before, meant, after,
                     last < line.size() ? "..." : "", std::string(columns(before), ' '),
                     std::string(tildes, '~'));
}

}  // namespace tyndall::loader
