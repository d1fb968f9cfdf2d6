// SPDX-License-Identifier: Apache-2.0
#include "tyndall/techniques/linear_rows.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace tyndall {

LinearRows::LinearRows(std::span<const float> values, int rows)
    : values_(values.begin(), values.end()),
      cdf_(values.size()),
      nodes_(values.size() / static_cast<size_t>(rows)),
      rows_(rows) {
  assert(nodes_ >= 2 && nodes_ * static_cast<size_t>(rows) == values.size());
  const double width = 1.0 / static_cast<double>(nodes_ - 1);
  for (size_t first = 0; first < values.size(); first += nodes_) {
    double sum = 0;
    for (size_t i = first + 1; i < first + nodes_; ++i) {
      sum += 0.5 * (double(values_[i - 1]) + double(values_[i])) * width;
      cdf_[i] = static_cast<float>(sum);
    }
  }
}

LinearRows::Blend LinearRows::blend(int row, int stride, float weight) const {
  assert(0 <= row && row < rows_ && 0 <= row + stride && row + stride < rows_);
  const size_t a = static_cast<size_t>(row) * nodes_;
  const size_t b = static_cast<size_t>(row + stride) * nodes_;
  Blend blend;
  blend.value_a_ = values_.data() + a;
  blend.value_b_ = values_.data() + b;
  blend.cdf_a_ = cdf_.data() + a;
  blend.cdf_b_ = cdf_.data() + b;
  blend.weight_ = weight;
  blend.cells_ = static_cast<int>(nodes_) - 1;
  return blend;
}

float LinearRows::Blend::density(float x) const {
  const float position = (x > 0 ? std::min(x, 1.0f) : 0) * static_cast<float>(cells_);
  const int i = std::min(static_cast<int>(position), cells_ - 1);
  const float f = position - static_cast<float>(i);
  return (1 - f) * at(value_a_, value_b_, i) + f * at(value_a_, value_b_, i + 1);
}

float LinearRows::Blend::cdf(float x) const {
  const float position = (x > 0 ? std::min(x, 1.0f) : 0) * static_cast<float>(cells_);
  const int i = std::min(static_cast<int>(position), cells_ - 1);
  const float f = position - static_cast<float>(i);
  const float a = at(value_a_, value_b_, i), b = at(value_a_, value_b_, i + 1);
  return at(cdf_a_, cdf_b_, i) + f * (a + 0.5f * f * (b - a)) / static_cast<float>(cells_);
}

float LinearRows::Blend::invert(float part) const {
  int i = 0, count = cells_ - 1;  // the last cell that starts at or below `part`
  while (count > 0) {
    const int half = (count + 1) / 2;
    const bool is_below = at(cdf_a_, cdf_b_, i + half) <= part;
    i += is_below ? half : 0;
    count = is_below ? count - half : half - 1;
  }
  const float a = at(value_a_, value_b_, i), b = at(value_a_, value_b_, i + 1);
  const float mass = std::max((part - at(cdf_a_, cdf_b_, i)) * static_cast<float>(cells_), 0.0f);
  const float root = std::sqrt(std::max(a * a + 2 * (b - a) * mass, 0.0f));
  const float f = a + root > 0 ? std::min(2 * mass / (a + root), 1.0f) : 0;
  return (static_cast<float>(i) + f) / static_cast<float>(cells_);
}

}  // namespace tyndall
