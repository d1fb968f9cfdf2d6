// SPDX-License-Identifier: Apache-2.0
#include "support/cell_integral.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tyndall {
namespace {

using Function = std::function<double(double, double)>;

constexpr int max_depth = 24;
constexpr int max_cells = 20'000;
constexpr double absolute_tolerance = 1e-8;
constexpr double relative_tolerance = 1e-4;  // above the rounding of float densities

// Gauss-Legendre with three nodes a side, exact for polynomials of degree five.
double gauss(const Function& f, const Cell& c) {
  constexpr std::array<double, 3> nodes{0.11270166537925831, 0.5, 0.88729833462074169};
  constexpr std::array<double, 3> weights{5.0 / 18, 8.0 / 18, 5.0 / 18};
  double sum = 0;
  for (size_t i = 0; i < 3; ++i)
    for (size_t j = 0; j < 3; ++j)
      sum +=
          weights[i] * weights[j] *
          f(std::lerp(c.x_min, c.x_max, nodes[i]), std::lerp(c.y_min, c.y_max, nodes[j]));
  return sum * (c.x_max - c.x_min) * (c.y_max - c.y_min);
}

// Asks for agreement on two levels in turn: at a jump one may agree by accident.
// Gives up when the budget of cells is spent: on what cannot be integrated, such as 1 / x.
double refine(const Function& f, const Cell& c, double coarse, int depth, bool agreed,
              int& budget) {
  const double x = 0.5 * (c.x_min + c.x_max), y = 0.5 * (c.y_min + c.y_max);
  const std::array<Cell, 4> quarters{{{c.x_min, x, c.y_min, y},
                                      {x, c.x_max, c.y_min, y},
                                      {c.x_min, x, y, c.y_max},
                                      {x, c.x_max, y, c.y_max}}};
  std::array<double, 4> parts{};
  double fine = 0;
  for (size_t i = 0; i < 4; ++i) fine += parts[i] = gauss(f, quarters[i]);
  const double tolerance =
      std::max(absolute_tolerance, relative_tolerance * std::abs(fine));
  const bool agrees = !(std::abs(fine - coarse) > tolerance);
  if (depth >= max_depth || --budget < 0 || (agreed && agrees)) return fine;
  double sum = 0;
  for (size_t i = 0; i < 4; ++i)
    sum += refine(f, quarters[i], parts[i], depth + 1, agrees, budget);
  return sum;
}

}  // namespace

double cell_integral(const Function& f, const Cell& cell) {
  int budget = max_cells;
  return refine(f, cell, gauss(f, cell), 0, false, budget);
}

}  // namespace tyndall
