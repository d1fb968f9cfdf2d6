// SPDX-License-Identifier: Apache-2.0
#include "support/chi_square.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <ostream>

#include "support/cell_integral.h"
#include "tyndall/math/frame.h"
#include "tyndall/sampling/random.h"

namespace tyndall {
namespace {

// Counts of samples and their expectation, cell by cell.
struct Histogram {
  std::vector<Cell> cells;
  std::vector<double> expected;  // number of samples
  std::vector<int64_t> counts;
  int64_t n = 0;

  Histogram(std::vector<Cell> the_cells, int64_t samples)
      : cells(std::move(the_cells)),
        expected(cells.size()),
        counts(cells.size()),
        n(samples) {}
};

// Rectangles between the given bounds, x fastest.
std::vector<Cell> grid(const std::vector<double>& x, const std::vector<double>& y) {
  std::vector<Cell> cells;
  for (size_t j = 0; j + 1 < y.size(); ++j)
    for (size_t i = 0; i + 1 < x.size(); ++i)
      cells.push_back({x[i], x[i + 1], y[j], y[j + 1]});
  return cells;
}

std::vector<double> even_bounds(double min, double max, int cells) {
  std::vector<double> bounds;
  for (int i = 0; i <= cells; ++i) bounds.push_back(std::lerp(min, max, double(i) / cells));
  return bounds;
}

size_t find_cell(const std::vector<double>& bounds, double x) {
  const auto above = std::upper_bound(bounds.begin() + 1, bounds.end() - 1, x);
  return static_cast<size_t>(above - bounds.begin()) - 1;
}

// Groups of cells, smallest first, each expecting at least five samples.
struct Pool {
  double expected = 0;
  int64_t count = 0;
};

std::vector<Pool> pool_cells(const Histogram& h, double missing_expected, int64_t missing) {
  std::vector<Pool> all;
  for (size_t i = 0; i < h.cells.size(); ++i) all.push_back({h.expected[i], h.counts[i]});
  all.push_back({missing_expected, missing});
  std::sort(all.begin(), all.end(),
            [](const Pool& a, const Pool& b) { return a.expected < b.expected; });
  std::vector<Pool> pools;
  Pool current;
  for (const Pool& p : all) {
    current.expected += p.expected;
    current.count += p.count;
    if (current.expected < 5) continue;
    pools.push_back(current);
    current = {};
  }
  if (pools.empty()) return {current};
  pools.back().expected += current.expected;
  pools.back().count += current.count;
  return pools;
}

std::string describe_worst_cells(const Histogram& h) {
  std::vector<size_t> order(h.cells.size());
  for (size_t i = 0; i < order.size(); ++i) order[i] = i;
  const auto badness = [&](size_t i) {
    const double difference = static_cast<double>(h.counts[i]) - h.expected[i];
    return difference * difference / std::max(h.expected[i], 5.0);
  };
  const size_t shown = std::min<size_t>(8, order.size());
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(shown),
                    order.end(),
                    [&](size_t a, size_t b) { return badness(a) > badness(b); });
  std::string text;
  for (size_t k = 0; k < shown; ++k) {
    const Cell& c = h.cells[order[k]];
    text += fmt::format(
        "  [{:.5g}, {:.5g}] x [{:.5g}, {:.5g}]: {} samples, {:.2f} expected\n", c.x_min,
        c.x_max, c.y_min, c.y_max, h.counts[order[k]], h.expected[order[k]]);
  }
  return text;
}

// Fills in all that follows from the counts.
void conclude(const Histogram& h, ChiSquareResult& r) {
  const auto n = static_cast<double>(h.n);
  for (size_t i = 0; i < h.cells.size(); ++i) {
    r.mass += h.expected[i] / n;
    if (!(h.expected[i] > 0)) r.samples_in_empty_cells += h.counts[i];
  }
  const std::vector<Pool> pools = pool_cells(h, n * std::max(0.0, 1 - r.mass), r.missing);
  for (const Pool& p : pools) {
    const double difference = static_cast<double>(p.count) - p.expected;
    r.statistic += difference * difference / std::max(p.expected, 1e-3);
  }
  r.degrees_of_freedom = static_cast<int>(pools.size()) - 1;
  r.worst_cells = describe_worst_cells(h);
  if (r.degrees_of_freedom < 1 || !std::isfinite(r.statistic)) {
    r.p_value = std::numeric_limits<double>::quiet_NaN();
    return;
  }
  const boost::math::chi_squared distribution(r.degrees_of_freedom);
  r.p_value = boost::math::cdf(boost::math::complement(distribution, r.statistic));
}

void count_zero_pdf(double pdf, ChiSquareResult& r) {
  if (!(pdf > 0 && std::isfinite(pdf))) ++r.samples_of_zero_pdf;
}

// Bounds of 1 - cos(theta), from 0 to 2.
std::vector<double> ring_bounds(const SphereCells& cells) {
  std::vector<double> bounds = even_bounds(0, 2, cells.rings);
  if (cells.concentration == 0) return bounds;
  const double k = cells.concentration;
  for (double& b : bounds) b = 2 * std::expm1(k * b / 2) / std::expm1(k);
  bounds.back() = 2;
  return bounds;
}

// 1 - cos(theta) of a unit vector; exact near the pole, where 1 - z is not.
double one_minus_cos(Vec3 w) {
  const double x = w.x, y = w.y, z = w.z;
  return z > 0 ? (x * x + y * y) / (1 + z) : 1 - z;
}

Vec3 direction(double one_minus_z, double phi) {
  const double r = std::sqrt(std::max(0.0, one_minus_z * (2 - one_minus_z)));
  return {static_cast<float>(r * std::cos(phi)), static_cast<float>(r * std::sin(phi)),
          static_cast<float>(1 - one_minus_z)};
}

}  // namespace

std::ostream& operator<<(std::ostream& out, const ChiSquareResult& r) {
  return out << fmt::format(
             "p = {:.3g}, chi-square = {:.2f} with {} degrees of freedom, mass = {:.6f}, "
             "{} samples of zero pdf, {} in empty cells, {} missing\n{}",
             r.p_value, r.statistic, r.degrees_of_freedom, r.mass, r.samples_of_zero_pdf,
             r.samples_in_empty_cells, r.missing, r.worst_cells);
}

ChiSquareResult chi_square_sphere(const std::function<std::optional<Vec3>(Vec2)>& sample,
                                  const std::function<double(Vec3)>& pdf, int64_t n,
                                  uint64_t seed, const SphereCells& cells) {
  const std::vector<double> rings = ring_bounds(cells);
  const std::vector<double> sectors =
      even_bounds(-std::numbers::pi, std::numbers::pi, cells.sectors);
  const Frame frame = Frame::from_z(cells.pole);
  Histogram h(grid(sectors, rings), n);
  const auto density = [&](double phi, double one_minus_z) {
    return pdf(frame.to_world(direction(one_minus_z, phi)));
  };
  for (size_t i = 0; i < h.cells.size(); ++i)
    h.expected[i] = static_cast<double>(n) * cell_integral(density, h.cells[i]);

  ChiSquareResult r;
  r.moments.resize(3);
  RandomStream random(hash(seed, uint64_t{0x5eed}));
  for (int64_t k = 0; k < n; ++k) {
    const std::optional<Vec3> w = sample(random.next_2d());
    if (!w || !is_finite(*w)) {
      ++r.missing;
      continue;
    }
    count_zero_pdf(pdf(*w), r);
    const Vec3 local = frame.to_local(*w);
    const size_t ring = find_cell(rings, one_minus_cos(local));
    const size_t sector = find_cell(sectors, std::atan2(double{local.y}, double{local.x}));
    ++h.counts[ring * (sectors.size() - 1) + sector];
    for (int axis = 0; axis < 3; ++axis) r.moments[size_t(axis)].add(double{(*w)[axis]});
  }
  conclude(h, r);
  return r;
}

ChiSquareResult chi_square_line(const std::function<std::optional<float>(float)>& sample,
                                const std::function<double(double)>& pdf, double min,
                                double max, int64_t n, uint64_t seed, int cells) {
  const std::vector<double> bounds = even_bounds(min, max, cells);
  Histogram h(grid(bounds, {0, 1}), n);
  for (size_t i = 0; i < h.cells.size(); ++i)
    h.expected[i] = static_cast<double>(n) *
                    cell_integral([&](double x, double) { return pdf(x); }, h.cells[i]);

  ChiSquareResult r;
  r.moments.resize(1);
  RandomStream random(hash(seed, uint64_t{0x5eed}));
  for (int64_t k = 0; k < n; ++k) {
    const std::optional<float> x = sample(random.next_1d());
    if (!x || !(double{*x} >= min && double{*x} <= max)) {
      ++r.missing;
      continue;
    }
    count_zero_pdf(pdf(double{*x}), r);
    ++h.counts[find_cell(bounds, double{*x})];
    r.moments[0].add(double{*x});
  }
  conclude(h, r);
  return r;
}

ChiSquareResult chi_square_square(const std::function<std::optional<Vec2>(Vec2)>& sample,
                                  const std::function<double(Vec2)>& pdf, int64_t n,
                                  uint64_t seed, int cells_per_side) {
  const std::vector<double> bounds = even_bounds(0, 1, cells_per_side);
  Histogram h(grid(bounds, bounds), n);
  const auto density = [&](double x, double y) {
    return pdf({static_cast<float>(x), static_cast<float>(y)});
  };
  for (size_t i = 0; i < h.cells.size(); ++i)
    h.expected[i] = static_cast<double>(n) * cell_integral(density, h.cells[i]);

  ChiSquareResult r;
  r.moments.resize(2);
  RandomStream random(hash(seed, uint64_t{0x5eed}));
  for (int64_t k = 0; k < n; ++k) {
    const std::optional<Vec2> p = sample(random.next_2d());
    if (!p || !(p->x >= 0 && p->x <= 1 && p->y >= 0 && p->y <= 1)) {
      ++r.missing;
      continue;
    }
    count_zero_pdf(pdf(*p), r);
    ++h.counts[find_cell(bounds, double{p->y}) * (bounds.size() - 1) +
               find_cell(bounds, double{p->x})];
    r.moments[0].add(double{p->x});
    r.moments[1].add(double{p->y});
  }
  conclude(h, r);
  return r;
}

}  // namespace tyndall
