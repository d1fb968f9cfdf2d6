// SPDX-License-Identifier: Apache-2.0
#include "tyndall/integrators/connection_leg.h"

#include <algorithm>
#include <cmath>

namespace tyndall {
namespace {

// Connections look no further than the proxy lets this share of the light through.
constexpr float end_transmittance = 1e-5f;

// The share of the samples that does not trust the bins.
constexpr float floor_share = 0.1f;

}  // namespace

ConnectionContext::ConnectionContext(const Scene& scene, const ConnectionSettings& settings)
    : scene_(&scene), settings_(settings), light_choice_(scene.lights(), scene.bounds()) {
  std::map<float, std::shared_ptr<const ScatteringTables>> by_g;
  for (const Medium& medium : scene.description().media) {
    const float g = medium.phase().mean_cosine();
    std::shared_ptr<const ScatteringTables>& tables = by_g[g];
    if (!tables) tables = std::make_shared<const ScatteringTables>(g);
    tables_[&medium] = tables;
  }
}

const ScatteringTables& ConnectionContext::tables(const Medium& medium) const {
  return *tables_.at(&medium);
}

std::optional<Vec3> Pivots::operator()(size_t light) const {
  RandomStream stream(hash(key_, light));
  const std::optional<LightPoint> point = scene_->lights()[light].sample_point(stream.next_2d());
  if (!point) return std::nullopt;
  return point->on.p;
}

ConnectionLeg::ConnectionLeg(const ConnectionContext& context, const Pivots& pivots, Leg& leg)
    : context_(&context), pivots_(&pivots), ray_(leg.ray()), proxy_(leg) {
  if (proxy_.is_empty()) return;
  t_max_ = proxy_.distance_to(end_transmittance);
  lights_ = context.light_choice().along(ray_, proxy_.t_min(), t_max_);
}

std::optional<SelectedLight> ConnectionLeg::select_light(float u) const {
  return lights_.select(context_->scene().lights(), u);
}

template <int K>
DistanceWeights<K> ConnectionLeg::weights(const DistanceTaps<K>& taps, bool with_phase) const {
  auto weights = DistanceWeights<K>::ones();
  LegProxy::Cursor cursor(proxy_);
  for (size_t i = 0; i < K; ++i) {
    cursor.move_to(taps.t[i]);
    // On the way from the tap to the light, the medium is taken to be as it is at the tap.
    const float to_light = cursor.medium() && cursor.medium()->is_homogeneous()
                               ? fast_exp(-cursor.sigma_t() * taps.distance[i])
                               : 1;
    weights.values[i] = cursor.sigma_t() * cursor.transmittance() * to_light;
  }
  if (with_phase) {
    const Medium* medium = proxy_.first_medium();
    weights.multiply_phase(taps, medium->phase().mean_cosine());
  }
  return weights;
}

ConnectionLeg::PerLight& ConnectionLeg::aim_at(size_t light) {
  if (cache_ && cache_->light == light) return *cache_;
  cache_.emplace();
  cache_->light = light;
  const std::optional<Vec3> pivot = (*pivots_)(light);
  if (!pivot) return *cache_;
  const EquiangularSampling base(ray_, *pivot, proxy_.t_min(), t_max_);
  if (!(base.integral() > 0)) return *cache_;
  const PivotSegment& segment = base.segment();
  const float nearest = segment.s_near() < 0 ? segment.h() : segment.r_near();
  const float farthest = segment.r(segment.s(segment.length()));
  if (!(farthest > context_->settings().min_distance_ratio * nearest)) return *cache_;
  cache_->single.emplace(base, weights(base.taps<32>(), true), floor_share);
  return *cache_;
}

const ConnectionLeg::Single* ConnectionLeg::single(size_t light) {
  if (is_empty() || !context_->settings().single) return nullptr;
  PerLight& cache = aim_at(light);
  return cache.single ? &*cache.single : nullptr;
}

const ConnectionLeg::Double* ConnectionLeg::dual(size_t light) {
  if (is_empty() || !context_->settings().dual) return nullptr;
  PerLight& cache = aim_at(light);
  if (!cache.single) return nullptr;
  if (!cache.has_dual) {
    cache.has_dual = true;
    const DoubleScatteringDistance base(context_->tables(*proxy_.first_medium()),
                                        cache.single->base().segment());
    if (base.integral() > 0)
      cache.dual.emplace(base, weights(base.taps<16>(), false), floor_share);
  }
  return cache.dual ? &*cache.dual : nullptr;
}

}  // namespace tyndall
