// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace tyndall::app {

/// Rows of cells in columns of equal width, the first column to the left, the others to the
/// right; the first row is the heading.
std::string text_table(const std::vector<std::vector<std::string>>& rows);

/// Four significant digits: "0.01234", "1.234e-05".
std::string short_number(double x);

}  // namespace tyndall::app
