// SPDX-License-Identifier: Apache-2.0
#include "tyndall/guiding/record_training.h"

#include <algorithm>
#include <cmath>

namespace tyndall {

void RecordSummary::add(const TrainingSample& s) {
  const double px = s.p.x, py = s.p.y, pz = s.p.z;
  count += 1;
  if (s.weight > 0) lit += 1;
  x += px, y += py, z += pz;
  xx += px * px, yy += py * py, zz += pz * pz;
  sigma_t += s.sigma_t;
  if (s.light_distance > 0)
    inverse_light_distance += 1 / static_cast<double>(s.light_distance);
  for (const float d : {s.scatter_distance, s.occluder_distance})
    if (d > 0 && d < infinity) {
      features += 1;
      inverse_feature_distance += 1 / static_cast<double>(d);
    }
}

Vec3 RecordSummary::center() const {
  if (count == 0) return {};
  return {static_cast<float>(x / count), static_cast<float>(y / count),
          static_cast<float>(z / count)};
}

Vec3 RecordSummary::variance() const {
  if (count == 0) return {};
  const auto along = [&](double sum, double squares) {
    const double mean = sum / count;
    return static_cast<float>(std::max(squares / count - mean * mean, 0.0));
  };
  return {along(x, xx), along(y, yy), along(z, zz)};
}

float validity_radius(double relative_change, double inverse_light_distance, double sigma_t,
                      double inverse_feature_distance, double angular_derivative) {
  const double slope = std::hypot(1.0, angular_derivative) *
                           (inverse_light_distance + inverse_feature_distance) +
                       sigma_t;
  return slope > 0 ? static_cast<float>(relative_change / slope) : infinity;
}

double ClusterContribution::value() const {
  return count > 0 ? std::sqrt(squared_weight / count) : 0;
}

Frame reference_frame(std::span<const TrainingSample* const> samples) {
  Vec3 sum;
  for (const TrainingSample* s : samples) sum += s->light_direction;
  const float l = length(sum);
  return Frame::from_z(l > 1e-3f * static_cast<float>(samples.size())
                           ? sum / l
                           : samples.front()->light_direction);
}

void GuideTraining::train(std::span<const TrainingSample* const> samples,
                          const RecordTrainingSettings& settings) {
  std::vector<WeightedPoint> points;
  points.reserve(samples.size());
  ShareStatistics<direction_techniques> statistics;
  for (const TrainingSample* s : samples) {
    const SquarePoint q = guide.square(s->light_direction).point(s->wi);
    points.push_back({q.p, s->weight});
    const DirectionShares densities{
        s->mixture_pdf > 0 ? s->mixture_pdf : guide.mixture.pdf(q.p) * q.density,
        s->joint_pdf > 0 ? s->joint_pdf : q.density, s->phase_pdf};
    statistics.add(s->weight * s->scattered, s->pdf, densities, guide.shares,
                   settings.shares.target);
  }
  if (guide.mixture.is_uniform()) {  // it was not drawn from: its share says nothing
    start_mixture(points, samples.front()->key, settings);
  } else {
    guide.shares = statistics.improve(guide.shares, settings.shares);
    continue_mixture(points, settings);
  }
}

void GuideTraining::start_mixture(std::span<const WeightedPoint> points, uint64_t seed,
                                  const RecordTrainingSettings& settings) {
  std::vector<WeightedPoint> lit = pending;
  std::copy_if(points.begin(), points.end(), std::back_inserter(lit),
               [](const WeightedPoint& s) { return s.weight > 0; });
  MixtureStatistics weights;
  weights.add(guide.mixture, lit);
  if (lit.size() < settings.least_samples ||
      weights.effective_count() < settings.least_effective) {
    pending.assign(lit.end() - std::min(std::ssize(lit), std::ptrdiff_t{max_pending}),
                   lit.end());
    return;
  }
  const GaussianMixture start = initial_mixture(lit, seed, settings.em);
  guide.set_mixture(fit_batch(start, lit, settings.em));
  MixtureStatistics batch;
  batch.add(guide.mixture, lit);
  em = OnlineEm();
  em.absorb(batch, settings.em);
  pending = {};
}

void GuideTraining::continue_mixture(std::span<const WeightedPoint> points,
                                     const RecordTrainingSettings& settings) {
  for (size_t begin = 0; begin < points.size(); begin += settings.samples_per_step) {
    const size_t n = std::min<size_t>(settings.samples_per_step, points.size() - begin);
    MixtureStatistics batch;
    batch.add(guide.mixture, points.subspan(begin, n));
    em.absorb(batch, settings.em);
    guide.mixture = em.maximize(guide.mixture, settings.em);
  }
  guide.set_mixture(guide.mixture);
}

void GuideTraining::write(ByteWriter& out) const {
  out.write(cluster);
  out.write(static_cast<uint32_t>(guide.measure));
  for (const Vec3 axis : {guide.reference.x, guide.reference.y, guide.reference.z})
    out.write(axis);
  for (const float share : guide.shares) out.write(share);
  guide.mixture.write(out);
  em.write(out);
  out.write(static_cast<uint32_t>(pending.size()));
  for (const WeightedPoint& s : pending)
    out.write(s.p.x), out.write(s.p.y), out.write(s.weight);
}

void GuideTraining::read(ByteReader& in) {
  in.read(cluster);
  const auto measure = in.read_as<uint32_t>();
  if (measure > static_cast<uint32_t>(SquareMeasure::solid_angle)) in.fail();
  guide.measure = static_cast<SquareMeasure>(measure);
  for (Vec3* axis : {&guide.reference.x, &guide.reference.y, &guide.reference.z})
    in.read(*axis);
  for (float& share : guide.shares) in.read(share);
  GaussianMixture mixture;
  mixture.read(in);
  guide.set_mixture(mixture);
  em.read(in);
  const auto size = in.read_as<uint32_t>();
  if (size > max_pending) return in.fail();
  pending.resize(size);
  for (WeightedPoint& s : pending) in.read(s.p.x), in.read(s.p.y), in.read(s.weight);
}

}  // namespace tyndall
