// SPDX-License-Identifier: Apache-2.0
#include "tyndall/guiding/online_em.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <optional>
#include <vector>

#include "tyndall/sampling/random.h"

namespace tyndall {

namespace {

// A component with a smaller share of the weight than this says nothing of its mean.
constexpr double negligible_share = 1e-12;

bool is_usable(const WeightedPoint& s) {
  return s.weight >= 0 && s.weight < infinity && s.p.x >= 0 && s.p.x <= 1 && s.p.y >= 0 &&
         s.p.y <= 1;
}

Covariance2 bounded(double xx, double xy, double yy, const EmSettings& settings) {
  xx = std::max(xx, settings.min_variance);
  yy = std::max(yy, settings.min_variance);
  const double limit = std::sqrt(settings.max_squared_correlation * xx * yy);
  return {static_cast<float>(xx), static_cast<float>(std::clamp(xy, -limit, limit)),
          static_cast<float>(yy)};
}

// An index in proportion to the weights; empty if they are all zero.
std::optional<size_t> choose(std::span<const double> weights, float u) {
  const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
  double rest = total * static_cast<double>(u);
  std::optional<size_t> last;
  for (size_t i = 0; i < weights.size(); ++i) {
    if (weights[i] == 0) continue;
    last = i;
    if (rest < weights[i]) break;
    rest -= weights[i];
  }
  return last;
}

}  // namespace

void MixtureStatistics::add(const GaussianMixture& mixture,
                            std::span<const WeightedPoint> points) {
  for (const WeightedPoint& s : points) {
    if (!is_usable(s)) {
      ++rejected;
      continue;
    }
    count += 1;
    if (s.weight == 0) continue;
    alignas(32) GaussianMixture::Lanes densities;
    float total = mixture.eval_components(s.p, densities);
    if (mixture.is_uniform()) {
      densities.fill(1);
      total = static_cast<float>(GaussianMixture::capacity);
    }
    const double wi = s.weight;
    weight += wi;
    squared_weight += wi * wi;
    log_density += mixture.is_uniform() ? 0 : wi * std::log(static_cast<double>(total));
    const double scale = wi / static_cast<double>(total);
    const double px = s.p.x, py = s.p.y, pxx = px * px, pxy = px * py, pyy = py * py;
    for (size_t k = 0; k < w.size(); ++k) {
      const double r = scale * static_cast<double>(densities[k]);
      w[k] += r;
      x[k] += r * px;
      y[k] += r * py;
      xx[k] += r * pxx;
      xy[k] += r * pxy;
      yy[k] += r * pyy;
    }
  }
}

void MixtureStatistics::discount(double factor) {
  count *= factor;
  weight *= factor;
  squared_weight *= factor * factor;
  log_density *= factor;
  for (Lanes* lanes : {&w, &x, &y, &xx, &xy, &yy})
    for (double& v : *lanes) v *= factor;
}

MixtureStatistics& MixtureStatistics::operator+=(const MixtureStatistics& o) {
  count += o.count;
  weight += o.weight;
  squared_weight += o.squared_weight;
  log_density += o.log_density;
  rejected += o.rejected;
  for (size_t k = 0; k < w.size(); ++k) {
    w[k] += o.w[k];
    x[k] += o.x[k];
    y[k] += o.y[k];
    xx[k] += o.xx[k];
    xy[k] += o.xy[k];
    yy[k] += o.yy[k];
  }
  return *this;
}

void MixtureStatistics::write(ByteWriter& out) const {
  for (const double v : {count, weight, squared_weight, log_density}) out.write(v);
  for (const Lanes* lanes : {&w, &x, &y, &xx, &xy, &yy})
    for (const double v : *lanes) out.write(v);
  out.write(rejected);
}

void MixtureStatistics::read(ByteReader& in) {
  for (double* v : {&count, &weight, &squared_weight, &log_density}) in.read(*v);
  for (Lanes* lanes : {&w, &x, &y, &xx, &xy, &yy})
    for (double& v : *lanes) in.read(v);
  in.read(rejected);
}

GaussianMixture maximize(const MixtureStatistics& s, const GaussianMixture& previous,
                         const EmSettings& settings) {
  if (previous.is_uniform() || !(s.weight > 0)) return previous;
  const double n = s.effective_count();
  std::array<GaussianComponent, GaussianMixture::capacity> components;
  for (int k = 0; k < previous.size(); ++k) {
    const auto i = static_cast<size_t>(k);
    const double share = s.w[i] / s.weight;
    GaussianComponent& c = components[i];
    c.weight = static_cast<float>((n * share + settings.weight_count) /
                                  (n + previous.size() * settings.weight_count));
    c.mean = previous.component(k).mean;
    // n * (second moments about the mean), normalised by the weight.
    double xx = 0, xy = 0, yy = 0;
    if (share > negligible_share) {
      const double mx = s.x[i] / s.w[i], my = s.y[i] / s.w[i];
      c.mean = {static_cast<float>(mx), static_cast<float>(my)};
      xx = n * share * (s.xx[i] / s.w[i] - mx * mx);
      xy = n * share * (s.xy[i] / s.w[i] - mx * my);
      yy = n * share * (s.yy[i] / s.w[i] - my * my);
    }
    const double normalization = settings.covariance_count + n * share;
    c.covariance =
        bounded((settings.covariance_scale + xx) / normalization, xy / normalization,
                (settings.covariance_scale + yy) / normalization, settings);
  }
  return GaussianMixture(std::span<const GaussianComponent>(components)
                             .first(static_cast<size_t>(previous.size())));
}

double penalized_log_likelihood(const GaussianMixture& mixture,
                                std::span<const WeightedPoint> points,
                                const EmSettings& settings) {
  MixtureStatistics s;
  s.add(mixture, points);
  double value = s.weight > 0 ? s.effective_count() * s.log_density / s.weight : 0;
  for (int k = 0; k < mixture.size(); ++k) {
    const GaussianComponent c = mixture.component(k);
    const double xx = c.covariance.xx, xy = c.covariance.xy, yy = c.covariance.yy;
    const double determinant = xx * yy - xy * xy;
    value += settings.weight_count * std::log(static_cast<double>(c.weight));
    value -= 0.5 * settings.covariance_count * std::log(determinant);
    value -=
        0.5 * settings.covariance_scale * (xx + yy) / determinant;  // trace of the inverse
  }
  return value;
}

GaussianMixture initial_mixture(std::span<const WeightedPoint> points, uint64_t seed,
                                const EmSettings& settings) {
  assert(1 <= settings.components && settings.components <= GaussianMixture::capacity);
  RandomStream random(seed);
  std::vector<double> importance(points.size()), priority(points.size());
  for (size_t i = 0; i < points.size(); ++i)
    importance[i] = is_usable(points[i]) ? static_cast<double>(points[i].weight) : 0;

  std::vector<GaussianComponent> components;
  std::vector<double> distance(points.size(), 2);  // squared, to the nearest mean so far
  const float variance = 0.25f / static_cast<float>(settings.components);
  while (static_cast<int>(components.size()) < settings.components) {
    for (size_t i = 0; i < points.size(); ++i) priority[i] = importance[i] * distance[i];
    const std::optional<size_t> chosen = choose(priority, random.next_1d());
    if (!chosen && components.empty()) return GaussianMixture();
    const Vec2 mean = chosen ? points[*chosen].p : random.next_2d();
    components.push_back(
        {.weight = 1, .mean = mean, .covariance = {variance, 0, variance}});
    for (size_t i = 0; i < points.size(); ++i) {
      const Vec2 d = points[i].p - mean;
      distance[i] = std::min(distance[i], static_cast<double>(dot(d, d)));
    }
  }
  return GaussianMixture(components);
}

GaussianMixture fit_batch(const GaussianMixture& start,
                          std::span<const WeightedPoint> points, const EmSettings& settings,
                          int max_sweeps, double tolerance) {
  GaussianMixture mixture = start;
  double last = -std::numeric_limits<double>::infinity();
  for (int sweep = 0; sweep < max_sweeps; ++sweep) {
    MixtureStatistics s;
    s.add(mixture, points);
    if (!(s.weight > 0)) break;
    const double likelihood = s.log_density / s.weight;
    if (likelihood - last < tolerance) break;
    last = likelihood;
    mixture = maximize(s, mixture, settings);
  }
  return mixture;
}

void OnlineEm::absorb(const MixtureStatistics& batch, const EmSettings& settings) {
  assert(settings.step_exponent > 0.5 && settings.step_exponent <= 1);
  if (!(batch.count > 0)) {
    sums_.rejected += batch.rejected;
    return;
  }
  // The recursion S <- (1 - g n^-a) S + g n^-a s leaves the past the share
  //   D = exp(-g ((n + m)^(1-a) - n^(1-a)) / (1-a))    of the mean after m more samples;
  // the past's sums are scaled such that adding the batch's gives that share.
  double keep = 0;
  if (samples_ > 0 && sums_.count > 0) {
    const double e = 1 - settings.step_exponent;
    const double growth = std::log1p(batch.count / samples_);
    const double steps =
        e > 0 ? std::pow(samples_, e) * std::expm1(e * growth) / e : growth;
    const double share = std::exp(-settings.step_gain * steps);
    keep = share * batch.count / ((1 - share) * sums_.count);
  }
  sums_.discount(std::min(keep, 1.0));
  sums_ += batch;
  samples_ += batch.count;
}

void OnlineEm::forget(double keep) {
  assert(keep > 0 && keep <= 1);
  sums_.discount(keep);
  sums_.squared_weight /= keep;
  samples_ *= keep;
}

void OnlineEm::write(ByteWriter& out) const {
  sums_.write(out);
  out.write(samples_);
}

void OnlineEm::read(ByteReader& in) {
  sums_.read(in);
  in.read(samples_);
}

}  // namespace tyndall
