// SPDX-License-Identifier: Apache-2.0
#include "tyndall/techniques/linear_table.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace tyndall {
namespace {

/// The integral over [0, x] of the line through value `a` with slope `b`.
float line_integral(float a, float b, float x) { return x * (a + 0.5f * b * x); }

/// The x up to which line_integral() is `mass`, in the form that does not cancel.
float invert_line_integral(float a, float b, float mass) {
  const float root = std::sqrt(std::max(a * a + 2 * b * mass, 0.0f));
  return 2 * mass / (a + root);
}

}  // namespace

LinearTable::LinearTable(std::span<const float> values, float x_min, float x_max)
    : values_(values.begin(), values.end()),
      integral_(values.size()),
      x_min_(x_min),
      x_max_(x_max),
      cells_(static_cast<int>(values.size()) - 1),
      cells_per_x_(static_cast<float>(cells_) / (x_max - x_min)) {
  assert(cells_ >= 1 && x_min < x_max);
  for (size_t i = 1; i < values.size(); ++i)
    integral_[i] = integral_[i - 1] + 0.5 * (double(values[i - 1]) + double(values[i]));
  const auto cells = static_cast<size_t>(cells_);
  guides_per_mass_ = cells_ / integral_.back();
  guide_.resize(cells + 1, static_cast<uint16_t>(cells_ - 1));
  for (size_t i = 0, cell = 0; i <= cells; ++i) {
    while (cell + 1 < cells && integral_[cell + 1] * guides_per_mass_ <= double(i)) ++cell;
    guide_[i] = static_cast<uint16_t>(cell);
  }
}

/// The cell in which the integral from node 0 has the given value.
int LinearTable::cell_at(double integral) const {
  const double position = std::clamp(integral * guides_per_mass_, 0.0, cells_ - 1.0);
  const int guide = static_cast<int>(position);
  int low = guide_[static_cast<size_t>(guide)];
  int count = guide_[static_cast<size_t>(guide) + 1] - low;
  while (count > 0) {
    const int half = (count + 1) / 2;
    const bool is_below = integral_[static_cast<size_t>(low + half)] <= integral;
    low += is_below ? half : 0;
    count = is_below ? count - half : half - 1;
  }
  return low;
}

LinearTable::Cursor LinearTable::cursor(float x, bool is_reversed) const {
  const float position = (is_reversed ? x_max_ - x : x - x_min_) * cells_per_x_;
  return {this, position == position ? position : 0, is_reversed};
}

float LinearTable::Cursor::value(float delta) const {
  const auto cells = static_cast<float>(table_->cells_);
  const float at = position_ + delta * table_->cells_per_x_;
  const float x = at > 0 ? std::min(at, cells) : 0;  // also takes NaN as zero
  const int i = std::min(static_cast<int>(x), table_->cells_ - 1);
  return std::lerp(node(i), node(i + 1), x - static_cast<float>(i));
}

float LinearTable::Cursor::integral(float delta) const {
  if (!(delta >= 0)) return 0;
  const int cells = table_->cells_;
  float rest = delta * table_->cells_per_x_, mass = 0, x = position_;
  if (!(x >= 0)) {
    const float below = std::min(rest, -x);
    mass = below * node(0);
    rest -= below;
    x = 0;
  }
  if (x < static_cast<float>(cells)) {
    int i = static_cast<int>(x);
    // The cells are counted off the way, not looked up at its end: what the float of the
    // position has lost then shifts the function, and never shortens the way.
    const float first = std::min(rest, static_cast<float>(i + 1) - x);
    const float slope = node(i + 1) - node(i);
    mass += line_integral(node(i) + slope * (x - static_cast<float>(i)), slope, first);
    rest -= first;
    ++i;
    const int whole = static_cast<int>(std::min(rest, static_cast<float>(cells - i)));
    mass += static_cast<float>(sum(i + whole) - sum(i));
    rest -= static_cast<float>(whole);
    i += whole;
    if (i < cells) {
      mass += line_integral(node(i), node(i + 1) - node(i), rest);
      rest = 0;
    }
  }
  mass += rest > 0 ? rest * node(cells) : 0;
  return mass / table_->cells_per_x_;
}

float LinearTable::Cursor::invert(float mass) const {
  if (!(mass >= 0)) return 0;
  const int cells = table_->cells_;
  float rest = mass * table_->cells_per_x_, way = 0, x = position_;
  if (!(x >= 0)) {
    const float below = -x * node(0);
    if (rest <= below) return mass / node(0);
    rest -= below;
    way = -x;
    x = 0;
  }
  if (x < static_cast<float>(cells)) {
    const int i = static_cast<int>(x);
    const float slope = node(i + 1) - node(i);
    const float start = node(i) + slope * (x - static_cast<float>(i));
    const float room = static_cast<float>(i + 1) - x;
    const float first = line_integral(start, slope, room);
    if (rest <= first)
      return (way + std::min(invert_line_integral(start, slope, rest), room)) /
             table_->cells_per_x_;
    // In the next cell the sums, which may be large, are still left alone.
    if (i + 1 < cells) {
      const float next_slope = node(i + 2) - node(i + 1);
      if (rest - first <= line_integral(node(i + 1), next_slope, 1))
        return (way + room + invert_line_integral(node(i + 1), next_slope, rest - first)) /
               table_->cells_per_x_;
    }
    const double target = sum(i + 1) + (rest - first);
    const int cell = table_->cell_at(step_ * target);
    const int j = std::max(step_ > 0 ? cell : cells - 1 - cell, i + 1);
    way += room + static_cast<float>(j - i - 1);
    rest = static_cast<float>(target - sum(j));
    const float b = j < cells ? node(j + 1) - node(j) : 0;
    const float within = invert_line_integral(node(j), b, std::max(rest, 0.0f));
    if (within <= 1) return (way + within) / table_->cells_per_x_;
    // Beyond the last node, or by rounding beyond the cell.
    if (j + 1 < cells) return (way + 1) / table_->cells_per_x_;
    way += static_cast<float>(cells - j);
    rest = static_cast<float>(target - sum(cells));
  }
  return (way + std::max(rest, 0.0f) / node(cells)) / table_->cells_per_x_;
}

}  // namespace tyndall
