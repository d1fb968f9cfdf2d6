// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace tyndall::loader {

/// The text with control characters and broken UTF-8 as question marks, tabs as blanks: one
/// column per character.
std::string printable(std::string_view text);

/// The source line with its number, and below it a caret at byte `begin` with tildes to the
/// end of the `length` bytes meant. Long lines are cut to the part around the caret; what
/// cannot be printed shows as a question mark. Two lines, no trailing newline.
std::string excerpt(std::string_view line, int line_number, size_t begin, size_t length);

}  // namespace tyndall::loader
