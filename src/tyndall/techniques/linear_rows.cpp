// SPDX-License-Identifier: Apache-2.0
#include "tyndall/techniques/linear_rows.h"

namespace tyndall {

LinearRows::LinearRows(std::span<const float> values, int rows, int pieces)
    : rows_(rows), row_cells_(static_cast<int>(values.size()) / rows - pieces) {
  assert(row_cells_ >= pieces && row_cells_ * static_cast<int>(fraction) <= UINT16_MAX);
  cells_.resize(static_cast<size_t>(rows) * static_cast<size_t>(row_cells_));
  const size_t nodes = values.size() / static_cast<size_t>(rows);
  for (int row = 0; row < rows; ++row)
    add_row(values.subspan(static_cast<size_t>(row) * nodes, nodes), row, pieces);
}

void LinearRows::add_row(std::span<const float> values, int row, int pieces) {
  const int of_piece = row_cells_ / pieces;
  const auto at = [&](int i) -> Cell& {
    return cells_[static_cast<size_t>(i * rows_ + row)];
  };
  const auto left = [&](int i) { return values.begin() + i + i / of_piece; };
  double mass = 0;
  for (int i = 0; i < row_cells_; ++i) mass += 0.5 * (double(left(i)[0]) + left(i)[1]);
  double sum = 0;
  int guides = 0;
  const auto end = static_cast<uint16_t>(row_cells_ * static_cast<int>(fraction));
  for (int i = 0; i < row_cells_; ++i) at(i).guide[0] = at(i).guide[1] = end;
  for (int i = 0; i < row_cells_; ++i) {
    const double a = left(i)[0] / mass, b = left(i)[1] / mass, part = 0.5 * (a + b);
    Cell& cell = at(i);
    cell.cdf = static_cast<float>(sum);
    cell.left = static_cast<float>(a);
    cell.right = static_cast<float>(b);
    for (; guides < row_cells_ && guides <= (sum + part) * row_cells_; ++guides) {
      const double rest = std::max(double(guides) / row_cells_ - sum, 0.0);
      const double root = std::sqrt(std::max(a * a + 2 * (b - a) * rest, 0.0));
      const double inside = a + root > 0 ? std::min(2 * rest / (a + root), 1.0) : 0;
      const auto guide = static_cast<uint16_t>((i + inside) * double(fraction));
      at(guides).guide[0] = guide;
      if (guides > 0) at(guides - 1).guide[1] = guide;
    }
    sum += part;
  }
}

}  // namespace tyndall
