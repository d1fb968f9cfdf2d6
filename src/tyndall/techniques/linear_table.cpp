// SPDX-License-Identifier: Apache-2.0
#include "tyndall/techniques/linear_table.h"

#include <cassert>

namespace tyndall {
namespace {

/// The integral over [0, x] of the line through value `a` with slope `b`.
float line_integral(float a, float b, float x) { return x * (a + 0.5f * b * x); }

/// The x up to which line_integral() is `mass`, in the form that does not cancel.
template <typename T>
T invert_line_integral(T a, T b, T mass) {
  const T root = std::sqrt(std::max(a * a + 2 * b * mass, T{0}));
  return 2 * mass / (a + root);
}

}  // namespace

LinearTable::LinearTable(std::span<const float> values, float x_min, float x_max)
    : nodes_(values.size()),
      x_min_(x_min),
      x_max_(x_max),
      cells_(static_cast<int>(values.size()) - 1),
      cells_per_x_(static_cast<float>(cells_) / (x_max - x_min)),
      x_per_cell_((x_max - x_min) / static_cast<float>(cells_)) {
  assert(cells_ >= 1 && cells_ < 2048 && x_min < x_max);
  for (size_t i = 0; i < values.size(); ++i) {
    nodes_[i].value = values[i];
    if (i > 0)
      nodes_[i].integral =
          nodes_[i - 1].integral + 0.5 * (double(values[i - 1]) + double(values[i]));
  }
  const double share = nodes_.back().integral / cells_;
  shares_per_integral_ = static_cast<float>(1 / share);
  size_t cell = 0;
  for (size_t i = 0; i < nodes_.size(); ++i) {
    const double integral = static_cast<double>(i) * share;
    while (cell + 2 < nodes_.size() && nodes_[cell + 1].integral <= integral) ++cell;
    const double a = values[cell], b = values[cell + 1] - a;
    const double inside = invert_line_integral(a, b, integral - nodes_[cell].integral);
    const double position = static_cast<double>(cell) + std::clamp(inside, 0.0, 1.0);
    nodes_[i].guide[0] = static_cast<uint16_t>(position * double(fraction));
    if (i > 0) nodes_[i - 1].guide[1] = nodes_[i].guide[0];
  }
}

/// The cell in which the integral from node 0 has the given value.
int LinearTable::cell_at(double integral) const {
  const float at = static_cast<float>(integral) * shares_per_integral_;
  const int share = std::clamp(static_cast<int>(at), 0, cells_ - 1);
  const auto [begin, end] = nodes_[static_cast<size_t>(share)].guide;
  const auto x = static_cast<float>(begin), y = static_cast<float>(end);
  const float there = x + (at - static_cast<float>(share)) * (y - x);
  int i = std::clamp(static_cast<int>(there * (1 / fraction)), 0, cells_ - 1);
  while (i + 1 < cells_ && nodes_[static_cast<size_t>(i) + 1].integral <= integral) ++i;
  while (i > 0 && nodes_[static_cast<size_t>(i)].integral > integral) --i;
  return i;
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
  return mass * table_->x_per_cell_;
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
  if (!(x < static_cast<float>(cells)))
    return (way + rest / node(cells)) * table_->x_per_cell_;
  const int i = static_cast<int>(x);
  const float slope = node(i + 1) - node(i);
  const float start = node(i) + slope * (x - static_cast<float>(i));
  const float room = static_cast<float>(i + 1) - x;
  const float first = line_integral(start, slope, room);
  if (rest > first) return invert_far(i + 1, way + room, rest - first);
  return (way + std::min(invert_line_integral(start, slope, rest), room)) *
         table_->x_per_cell_;
}

/// From node i, which `way` leads to, on until the integral has grown by `rest`.
float LinearTable::Cursor::invert_far(int i, float way, float rest) const {
  const int cells = table_->cells_;
  const double target = sum(i) + double{rest};
  if (target >= sum(cells)) {
    const auto beyond = static_cast<float>(target - sum(cells));
    return (way + static_cast<float>(cells - i) + beyond / node(cells)) *
           table_->x_per_cell_;
  }
  const int cell = table_->cell_at(double{sign_} * target);
  const int j = std::max(step_ > 0 ? cell : cells - 1 - cell, i);
  // Next to node i the sums, which may be large, are left alone.
  const float inside = j == i ? rest : std::max(static_cast<float>(target - sum(j)), 0.0f);
  const float part = invert_line_integral(node(j), node(j + 1) - node(j), inside);
  return (way + static_cast<float>(j - i) + std::min(part, 1.0f)) * table_->x_per_cell_;
}

}  // namespace tyndall
