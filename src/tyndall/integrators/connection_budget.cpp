// SPDX-License-Identifier: Apache-2.0
#include "tyndall/integrators/connection_budget.h"

#include <algorithm>
#include <cmath>

#include "tyndall/math/add_relaxed.h"
#include "tyndall/math/scalar.h"

namespace tyndall {
namespace {

// Rays that one connection, one leg of the walk with its next event estimation, and the
// mere possibility of connections from a leg cost.
constexpr std::array<double, effort_count> effort_cost{2, 6, 4, 3, 4, 3};
constexpr double leg_cost = 2.5, possible_cost = 1;

// What one connection more costs, in units of its rays: less than the overhead over all,
// most of which is for the first of a leg. Measured: the best of 1, 1.4, 2 and 2.8.
constexpr double more_of_a_kind = 1.4;

constexpr double least_paths = 4000, least_paths_for_price = 256;  // to judge by
constexpr double tail_errors = 5;  // standard errors of the variance of plain paths

// What connections to lit surfaces gain is more than lit_gain() says: it leaves out that
// what a walk finds varies together, and that walks end by chance. Measured, 1.4 to 8 times
// as much; where that matters most, with light that hides well, it is not close.
constexpr double lit_gain_caution = 3;

// A connection that seems worthless may still be all that finds something rare; most of
// what a pixel sees happens on the first leg.
constexpr double min_count_first = 0.25, min_count_later = 0.1, max_count = most_of_a_kind;
// Until something is known. Pairs tell most, and most on the first leg.
constexpr float first_count_first = 2, first_count_later = 1;

// Regions, across and down. Squares are weighed by the radiance of a region, which must be
// known much better than a few paths tell it: the fewer, the lower it would seem to vary.
constexpr int max_size = 8;
static_assert(max_size * max_size == max_regions);

// What a region has not seen yet is believed to be as elsewhere: so many records of it.
constexpr double prior_paths = 16, prior_records = 32;
// Relative to the mean radiance of the picture, added to that of a region: as in relMSE.
constexpr double epsilon = 0.01;

// Predictions this many times the typical one count as no more.
constexpr float largest_ratio = 64;

constexpr double cost_unit = 1.0 / 16, fine_unit = 1.0 / 65536;

// Records, relative to the mean radiance or its square, are kept in these units and
// clamped: one firefly must not decide.
constexpr double unit = 1e-8, largest = 1e4;
constexpr double fourth_unit = 1e-4;   // of the squares of squares
constexpr double largest_value = 100;  // whose square is the largest

int64_t quantize(double value) {
  return std::isfinite(value) ? static_cast<int64_t>(std::min(value, largest) / unit) : 0;
}

}  // namespace

struct ConnectionBudget::Worth {
  std::vector<double> weights, means;  // of squares, and radiance, by region
};

ConnectionBudget::ConnectionBudget(float mean_radiance, Vec2i resolution, double overhead,
                                   double least_efficiency)
    : overhead_(overhead),
      least_efficiency_(least_efficiency),
      scale_(mean_radiance > 0 ? 1 / mean_radiance : 1),
      resolution_(resolution),
      size_{std::clamp(resolution.x, 1, max_size), std::clamp(resolution.y, 1, max_size)},
      regions_(static_cast<size_t>(size_.x) * static_cast<size_t>(size_.y)),
      recent_(resolution),
      counts_(regions_.size()),
      typical_(regions_.size()),
      region_scales_(regions_.size(), static_cast<float>(scale_)) {
  for (auto& counts : counts_)
    for (size_t i = 0; i < counts.size(); ++i)
      counts[i] = i % depths == 0 ? first_count_first : first_count_later;
  by_squares_ = counts_;
}

size_t ConnectionBudget::region(Vec2i pixel) const {
  const auto part = [](int64_t i, int n, int size) {
    return static_cast<size_t>(std::clamp<int64_t>(i * size / std::max(n, 1), 0, size - 1));
  };
  return part(pixel.y, resolution_.y, size_.y) * static_cast<size_t>(size_.x) +
         part(pixel.x, resolution_.x, size_.x);
}

float ConnectionBudget::count(const ConnectionPlace& place) const {
  const float ratio = factor(place);
  const size_t i = cell(place.effort, place.depth);
  const float count = counts_[place.region][i] * ratio;
  // What is worth being made is not left to chance, however little it varies.
  const float least = std::min(by_squares_[place.region][i] * ratio, 1.0f);
  return std::clamp(count, least, static_cast<float>(max_count));
}

// The root of the second moment that the prediction leads to expect, half of which is taken
// to have nothing to do with it.
float ConnectionBudget::factor(const ConnectionPlace& place) const {
  const float typical = typical_[place.region][cell(place.effort, place.depth)];
  if (!(typical > 0 && place.predicted >= 0)) return 1;
  const float ratio = std::min(place.predicted / typical, largest_ratio);
  return std::sqrt(0.5f + 0.5f * sqr(ratio));
}

void ConnectionBudget::record_place(const ConnectionPlace& place) const {
  if (!(place.predicted > 0 && place.predicted < infinity)) return;
  Cell& c = regions_[place.region].cells[cell(place.effort, place.depth)];
  add_relaxed(c.predictions, 1);
  add_relaxed(c.logarithms,
              static_cast<int64_t>(std::log2(double{place.predicted}) / fine_unit));
  add_relaxed(c.factors, static_cast<int64_t>(double{factor(place)} / fine_unit));
}

// What is found at places where connections are rare stands for the others there.
void ConnectionBudget::record(const ConnectionPlace& place, float value) const {
  Cell& c = regions_[place.region].cells[cell(place.effort, place.depth)];
  const double chance = std::min(double{count(place)}, 1.0);
  add_relaxed(c.squares,
              quantize(sqr(double{value} * scale_) / (double{factor(place)} * chance)));
  add_relaxed(c.visits, static_cast<int64_t>(1 / (chance * fine_unit)));
}

void ConnectionBudget::record_pair(const ConnectionPlace& place,
                                   float half_squared_difference) const {
  Cell& c = regions_[place.region].cells[cell(place.effort, place.depth)];
  add_relaxed(c.variance, quantize(double{half_squared_difference} * sqr(scale_) /
                                   double{factor(place)}));
  add_relaxed(c.pairs, 1);
}

float ConnectionBudget::cost(Effort effort, int count) {
  return static_cast<float>(effort_cost[static_cast<size_t>(effort)] * count);
}

float ConnectionBudget::path_cost(int legs, float spent) const {
  return static_cast<float>((leg_cost + possible_cost) * legs + overhead_ * double{spent});
}

void ConnectionBudget::record_path(Vec2i pixel, const Finished& path) const {
  Region& r = regions_[region(pixel)];
  const double value = double{path.value} * scale_;
  // Clamped as squares are: else the variance of a pixel would seem too small, or none.
  recent_.record(pixel,
                 std::isfinite(value) ? quantize(std::min(value, largest_value)) : 0);
  add_relaxed(r.radiance, quantize(value));
  add_relaxed(r.paths, 1);
  add_relaxed(r.recent.values, quantize(value));
  add_relaxed(r.recent.squares, quantize(sqr(value)));
  add_relaxed(r.recent.paths, 1);
  add_relaxed(r.recent.cost,
              static_cast<int64_t>(double{path_cost(path.legs, path.spent)} / cost_unit));
  add_relaxed(r.recent.lit_gain, quantize(double{path.lit_gain} * sqr(scale_)));
  add_relaxed(r.recent.lit_cost,
              static_cast<int64_t>(overhead_ * double{path.lit_spent} / cost_unit));
}

void ConnectionBudget::record_plain_path(size_t region, const Finished& path) const {
  Tally& plain = regions_[region].plain;
  const double value = double{path.value} * scale_;
  const int64_t square = quantize(sqr(value));
  add_relaxed(plain.values, quantize(value));
  add_relaxed(plain.squares, square);
  add_relaxed(regions_[region].plain_fourths,
              static_cast<int64_t>(sqr(static_cast<double>(square) * unit) / fourth_unit));
  add_relaxed(plain.paths, 1);
  add_relaxed(plain.cost, static_cast<int64_t>(leg_cost * path.legs / cost_unit));
}

ConnectionBudget::Worth ConnectionBudget::worth() const {
  double radiance = 0, paths = 0;
  for (const Region& r : regions_) {
    radiance += static_cast<double>(r.radiance) * unit;
    paths += static_cast<double>(r.paths);
  }
  const double mean = radiance / std::max(paths, 1.0);
  Worth worth;
  for (const Region& r : regions_) {
    const double here = (static_cast<double>(r.radiance) * unit + prior_paths * mean) /
                        (static_cast<double>(r.paths) + prior_paths);
    worth.weights.push_back(1 / std::max(sqr(here) + epsilon * sqr(mean), 1e-30));
    worth.means.push_back(here);
  }
  return worth;
}

void ConnectionBudget::update() {
  const Worth now = worth();
  const Efficiency recent = efficiency(&Region::recent, now);
  if (recent.paths >= least_paths_for_price) price_ = variance_in_pixels(now) / recent.cost;
  if (price_ > 0)
    for (size_t i = 0; i < efforts * depths; ++i) update_cell(i, now);
  for (size_t r = 0; r < regions_.size(); ++r)
    region_scales_[r] = static_cast<float>(std::sqrt(now.weights[r]) * scale_);
  if (!is_decided_) decide(now);
  recent_.clear();
  for (Region& r : regions_)
    r.recent.values = r.recent.squares = r.recent.paths = r.recent.cost =
        r.recent.lit_gain = r.recent.lit_cost = 0;
}

ConnectionBudget::Efficiency ConnectionBudget::efficiency(Tally Region::*tally,
                                                          const Worth& worth) const {
  Efficiency sum{};
  for (size_t r = 0; r < regions_.size(); ++r) {
    const Tally& t = regions_[r].*tally;
    const auto n = static_cast<double>(t.paths);
    sum.mean += std::sqrt(worth.weights[r]) * static_cast<double>(t.values) * unit;
    sum.variance += worth.weights[r] *
                    (static_cast<double>(t.squares) * unit - n * sqr(worth.means[r]));
    sum.cost += static_cast<double>(t.cost) * cost_unit;
    sum.paths += n;
    sum.lit_gain += worth.weights[r] * static_cast<double>(t.lit_gain) * unit;
    sum.lit_cost += static_cast<double>(t.lit_cost) * cost_unit;
  }
  const double n = std::max(sum.paths, 1.0);
  return {.mean = sum.mean / n,
          .variance = sum.variance / n,
          .cost = sum.cost / n,
          .paths = sum.paths,
          .lit_gain = sum.lit_gain / n,
          .lit_cost = sum.lit_cost / n};
}

// Between the paths of each pixel; with one of each, between those of a region.
double ConnectionBudget::variance_in_pixels(const Worth& worth) const {
  double squares = 0, degrees = 0;
  for (size_t r = 0; r < regions_.size(); ++r)
    squares += worth.weights[r] * static_cast<double>(regions_[r].recent.squares) * unit;
  for (size_t i = 0; i < recent_.size(); ++i) {
    const auto n = static_cast<double>(recent_[i].count);
    if (n == 0) continue;
    const double sum = static_cast<double>(recent_[i].value) * unit;
    squares -= worth.weights[region(recent_.pixel(i))] * sqr(sum) / n;
    degrees += n - 1;
  }
  if (degrees == 0) return efficiency(&Region::recent, worth).variance;
  return std::max(squares / degrees, 0.0);
}

// Of the variance of plain paths.
double ConnectionBudget::standard_error(const Worth& worth, double paths) const {
  double fourths = 0;
  for (size_t r = 0; r < regions_.size(); ++r)
    fourths += sqr(worth.weights[r]) * static_cast<double>(regions_[r].plain_fourths) *
               fourth_unit;
  return std::sqrt(fourths) / std::max(paths, 1.0);
}

// Of heavy tails the worst is seldom seen: where the variance of plain paths is not well
// known, it is taken for as large as it may well be.
void ConnectionBudget::decide(const Worth& worth) {
  const Efficiency with = efficiency(&Region::recent, worth);
  const Efficiency without = efficiency(&Region::plain, worth);
  if (with.paths < least_paths || without.paths < least_paths) return;
  is_decided_ = true;
  lit_pays_ = with.lit_cost == 0 || (with.variance + lit_gain_caution * with.lit_gain) *
                                            (with.cost - with.lit_cost) >
                                        with.variance * with.cost;
  // Chance explains one standard error of the mean.
  const double missed =
      with.mean - without.mean -
      std::sqrt(std::max(without.variance, 0.0) / std::max(without.paths, 1.0));
  const double variance = without.variance +
                          tail_errors * standard_error(worth, without.paths) +
                          sqr(std::max(missed, 0.0)) * without.paths;
  pays_ = variance * without.cost > least_efficiency_ * with.variance * with.cost;
}

void ConnectionBudget::update_cell(size_t cell, const Worth& worth) {
  // Weighted sums and numbers of records.
  struct Mean {
    double sum = 0, records = 0;
    double with_prior(double value, double count) const {
      const double prior = records > 0 ? sum / records : 0;
      return (value + prior_records * prior) / (count + prior_records);
    }
  } variance, squares;
  for (size_t r = 0; r < regions_.size(); ++r) {
    const Cell& c = regions_[r].cells[cell];
    variance.sum += worth.weights[r] * static_cast<double>(c.variance) * unit;
    variance.records += static_cast<double>(c.pairs);
    squares.sum += worth.weights[r] * static_cast<double>(c.squares) * unit;
    squares.records += static_cast<double>(c.visits) * fine_unit;
  }
  if (squares.records == 0) return;
  const double mean_factor = update_typical(cell);
  const double cost = effort_cost[cell / depths] * more_of_a_kind * price_ * mean_factor;
  const double least =
      (cell % depths == 0 ? min_count_first : min_count_later) / mean_factor;
  for (size_t r = 0; r < regions_.size(); ++r) {
    const Cell& c = regions_[r].cells[cell];
    const double of_all =
        squares.with_prior(worth.weights[r] * static_cast<double>(c.squares) * unit,
                           static_cast<double>(c.visits) * fine_unit);
    double count = std::sqrt(of_all / cost);
    by_squares_[r][cell] = static_cast<float>(count);
    if (count > 1 && variance.records > 0) {
      const double of_pairs =
          variance.with_prior(worth.weights[r] * static_cast<double>(c.variance) * unit,
                              static_cast<double>(c.pairs));
      count = std::max(std::sqrt(of_pairs / cost), 1.0);
    }
    counts_[r][cell] = static_cast<float>(std::clamp(count, least, max_count));
  }
}

// The geometric mean of the predictions in each region. Returns the mean factor so far.
double ConnectionBudget::update_typical(size_t cell) {
  double count = 0, logarithms = 0, factors = 0;
  for (const Region& r : regions_) {
    count += static_cast<double>(r.cells[cell].predictions);
    logarithms += static_cast<double>(r.cells[cell].logarithms) * fine_unit;
    factors += static_cast<double>(r.cells[cell].factors) * fine_unit;
  }
  if (count == 0) return 1;
  for (size_t r = 0; r < regions_.size(); ++r) {
    const Cell& c = regions_[r].cells[cell];
    const double sum =
        static_cast<double>(c.logarithms) * fine_unit + prior_records * logarithms / count;
    typical_[r][cell] = static_cast<float>(
        std::exp2(sum / (static_cast<double>(c.predictions) + prior_records)));
  }
  return factors / count;
}

double ConnectionBudget::mean_count(Effort effort, int depth) const {
  double sum = 0;
  for (const auto& counts : counts_) sum += double{counts[cell(effort, depth)]};
  return sum / static_cast<double>(counts_.size());
}

}  // namespace tyndall
