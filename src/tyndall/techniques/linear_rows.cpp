// SPDX-License-Identifier: Apache-2.0
#include "tyndall/techniques/linear_rows.h"

#include <cassert>

namespace tyndall {

LinearRows::LinearRows(std::span<const float> values, int rows)
    : values_(values.begin(), values.end()),
      cdf_(values.size()),
      nodes_(values.size() / static_cast<size_t>(rows)),
      rows_(rows) {
  assert(nodes_ == block * block + 1);
  assert(nodes_ * static_cast<size_t>(rows) == values.size());
  const double width = 1.0 / static_cast<double>(nodes_ - 1);
  for (size_t first = 0; first < values.size(); first += nodes_) {
    double sum = 0;
    for (size_t i = first + 1; i < first + nodes_; ++i) {
      sum += 0.5 * (double(values_[i - 1]) + double(values_[i])) * width;
      cdf_[i] = static_cast<float>(sum);
    }
    for (size_t i = 0; i + 1 < nodes_; i += block) blocks_.push_back(cdf_[first + i]);
  }
}

}  // namespace tyndall
