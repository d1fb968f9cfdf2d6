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
}

LinearTable::Cursor LinearTable::cursor(float x, bool is_reversed) const {
  return {this, (is_reversed ? x_max_ - x : x - x_min_) * cells_per_x_, is_reversed};
}

float LinearTable::Cursor::value(float delta) const {
  const auto cells = static_cast<float>(table_->cells_);
  const float at = position_ + delta * table_->cells_per_x_;
  const float x = at > 0 ? std::min(at, cells) : 0;  // also takes NaN as zero
  const int i = std::min(static_cast<int>(x), table_->cells_ - 1);
  return std::lerp(node(i), node(i + 1), x - static_cast<float>(i));
}

float LinearTable::Cursor::integral(float delta) const {
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
    const double target = sum(i + 1) + (rest - first);
    const int j = last_node_below(target, i + 1);
    way += room + static_cast<float>(j - i - 1);
    rest = static_cast<float>(target - sum(j));
    if (j < cells)
      return (way + std::min(invert_line_integral(node(j), node(j + 1) - node(j), rest),
                             1.0f)) /
             table_->cells_per_x_;
  }
  return (way + std::max(rest, 0.0f) / node(cells)) / table_->cells_per_x_;
}

int LinearTable::Cursor::last_node_below(double target, int from) const {
  int low = from, count = table_->cells_ - from;  // sum(low) <= target, always
  while (count > 0) {
    const int half = (count + 1) / 2;
    const bool is_below = sum(low + half) <= target;
    low += is_below ? half : 0;
    count = is_below ? count - half : half - 1;
  }
  return low;
}

}  // namespace tyndall
