// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

namespace tyndall {

/// A rectangle of parameters.
struct Cell {
  double x_min, x_max, y_min, y_max;
};

/// The integral of f(x, y) over a cell, refined where f has peaks or jumps. Narrow peaks
/// are found by their tails only: one without tails between the first nodes is missed.
double cell_integral(const std::function<double(double, double)>& f, const Cell& cell);

}  // namespace tyndall
