// SPDX-License-Identifier: Apache-2.0
#include "tyndall/integrators/connection_leg.h"

#include <algorithm>

#include "tyndall/integrators/connection_budget.h"
#include "tyndall/math/vector_clones.h"

namespace tyndall {
namespace {

// Connections look no further than the proxy lets this share of the light through.
constexpr float end_transmittance = 1e-5f;

// Where legs let less through than this, walks collide often enough by themselves.
constexpr float least_forced_transmittance = 0.3f;

// The share of the samples that does not trust the bins.
constexpr float floor_share = 0.1f;
// The same where they hold predicted visibility, whose own floor adds to it.
constexpr float floor_share_of_visible = 0.05f;

// Where a spot light shines, from 0 to 1: the cone's edge as a ramp.
template <int K>
[[gnu::always_inline]] inline void multiply_cone(const SpotLight& light, const Ray& ray,
                                                 const DistanceTaps<K>& taps,
                                                 DistanceWeights<K>& weights) {
  const float c0 = dot(ray.o - light.p, light.axis), c1 = dot(ray.d, light.axis);
  const float scale = 1 / std::max(light.cos_falloff_start - light.cos_total, 1e-3f);
  std::array<float, K + 2> lit;
  for (size_t i = 0; i < K; ++i) {
    const float cosine = (c0 + c1 * taps.t[i]) / taps.distance[i];
    lit[i + 1] = std::clamp((cosine - light.cos_total) * scale, 0.0f, 1.0f);
  }
  multiply_mixed(lit, weights.values);
}

}  // namespace

ConnectionContext::ConnectionContext(const Scene& scene, const ConnectionSettings& settings)
    : scene_(&scene), settings_(settings), light_choice_(scene.lights(), scene.bounds()) {
  if (settings.visibility)
    visibility_ = settings.known_visibility
                      ? settings.known_visibility
                      : std::make_shared<const LightVisibility>(scene);
  const bool may_foresee = visibility_ && settings.far_visibility;
  for (size_t i = 0; may_foresee && i < scene.lights().size(); ++i)
    foresees_far_lights_ |= scene.lights()[i].is_infinite() && visibility_->knows(i);
  if (settings.lit_surfaces > 0) lit_.emplace(scene, settings.lit_surfaces, lit_places);
  if (settings.direction) guiding_ = std::make_unique<DirectionGuiding>(scene, settings);
  const Medium* filling = scene.filling_medium();
  if (filling && filling->is_homogeneous()) filling_sigma_t_ = filling->at({}).sigma_t();
  for (const Medium& medium : scene.description().media) {
    const float g = medium.phase().mean_cosine();
    std::unique_ptr<const ScatteringTables>& tables = by_mean_cosine_[g];
    if (!tables) tables = std::make_unique<const ScatteringTables>(g);
    tables_.emplace_back(&medium, tables.get());
  }
  std::sort(tables_.begin(), tables_.end());
}

const ScatteringTables& ConnectionContext::tables(const Medium& medium) const {
  const auto found =
      std::lower_bound(tables_.begin(), tables_.end(), &medium,
                       [](const auto& entry, const Medium* m) { return entry.first < m; });
  // Where media overlap, the tables of one of them.
  return found != tables_.end() && found->first == &medium
             ? *found->second
             : *by_mean_cosine_.at(medium.phase().mean_cosine());
}

std::optional<Vec3> Pivots::operator()(size_t light) const {
  if (last_light_ == light) return last_;
  last_light_ = light;
  last_.reset();
  RandomStream stream(hash(key_, light));
  const std::optional<LightPoint> point =
      scene_->lights()[light].sample_point(stream.next_2d());
  if (point) last_ = point->on.p;
  return last_;
}

ConnectionLeg::ConnectionLeg(const ConnectionContext& context, const Pivots& pivots,
                             Leg& leg, bool is_first)
    : context_(&context), pivots_(&pivots), ray_(leg.ray()), proxy_(leg) {
  if (proxy_.is_empty()) return;
  const bool may_pass =
      is_first && proxy_.collision_share() < 1 - least_forced_transmittance;
  forces_collisions_ =
      context.settings().single && (may_pass || context.foresees_far_lights());
  t_max_ = proxy_.distance_to(end_transmittance);
}

const LightProbabilities& ConnectionLeg::lights() {
  if (!lights_) {
    lights_ = context_->light_choice().along(ray_, proxy_.t_min(), t_max_);
    const DirectionGuiding* guiding = lights_->size() > 1 ? context_->guiding() : nullptr;
    if (guiding) lights_ = guiding->choose(*lights_, ray_.at(proxy_.distance_to(0.5f)));
  }
  return *lights_;
}

std::optional<SelectedLight> ConnectionLeg::select_light(float u) {
  return lights().select(context_->scene().lights(), u);
}

float ConnectionLeg::light_importance() {
  constexpr size_t few = 16;
  return context_->scene().lights().size() <= few ? lights().importance() : 0;
}

float ConnectionLeg::light_probability(size_t light) { return lights().probability(light); }

// One homogeneous medium all along, which is taken to reach to the light.
bool ConnectionLeg::is_homogeneous() const {
  return proxy_.is_uniform() && proxy_.first_medium()->is_homogeneous();
}

template <int K>
[[gnu::always_inline]] inline DistanceWeights<K> ConnectionLeg::weights(
    const DistanceTaps<K>& taps, bool with_phase) const {
  auto weights = DistanceWeights<K>::ones();
  const Medium* medium = proxy_.first_medium();
  if (is_homogeneous()) {
    weights.multiply_transmittance(taps, proxy_.first_sigma_t());
  } else {
    LegProxy::Cursor cursor(proxy_);
    for (size_t i = 0; i < K; ++i) {
      cursor.move_to(taps.t[i]);
      // What lies between the tap and the light is for LightVisibility to know.
      weights.values[i] = cursor.sigma_t() * cursor.transmittance();
    }
  }
  if (with_phase) weights.multiply_phase(taps, medium->phase().mean_cosine());
  return weights;
}

ConnectionLeg::PerLight& ConnectionLeg::aim_at(size_t light) {
  if (cache_ && cache_->light == light) return *cache_;
  cache_.emplace();
  cache_->light = light;
  cache_->base = base(light);
  cache_->varies = cache_->base && varies(cache_->base->segment());
  return *cache_;
}

std::optional<EquiangularSampling> ConnectionLeg::base(size_t light) const {
  const std::optional<Vec3> pivot = (*pivots_)(light);
  if (!pivot) return std::nullopt;
  const EquiangularSampling base(ray_, *pivot, proxy_.t_min(), t_max_);
  return base.integral() > 0 ? std::optional(base) : std::nullopt;
}

bool ConnectionLeg::varies(const PivotSegment& segment) const {
  const float nearest = segment.s_near() < 0 ? segment.h() : segment.r_near();
  const float farthest = segment.r(segment.s(segment.length()));
  return farthest > context_->settings().min_distance_ratio * nearest;
}

TYNDALL_VECTOR_CLONES
ConnectionLeg::Single ConnectionLeg::bin_single(size_t light,
                                                const EquiangularSampling& base) const {
  const DistanceTaps<32> few = base.taps<32>();
  DistanceWeights<32> factors = weights(few, true);
  const Light& the_light = context_->scene().lights()[light];
  if (const auto* spot = std::get_if<SpotLight>(&the_light.variant()))
    multiply_cone(*spot, ray_, few, factors);
  if (!context_->visibility()) return Single::with_bins_of(base, factors, floor_share);
  if (!is_homogeneous())
    context_->visibility()->multiply_transmittance(light, ray_, few.t, factors.values);
  // What varies fast is looked at more often than what varies slowly.
  constexpr int taps = 128;
  DistanceWeights<64> visible = factors.spread<64>();
  const float angle = base.integral() * base.segment().h();
  context_->visibility()->multiply(light, ray_, base.taps<taps>().t, angle / taps,
                                   visible.values);
  return Single(base, visible, floor_share_of_visible);
}

const ConnectionLeg::Single* ConnectionLeg::single(size_t light) {
  if (is_empty() || !context_->settings().single) return nullptr;
  PerLight& cache = aim_at(light);
  if (cache.varies && !cache.single) cache.single = bin_single(light, *cache.base);
  return cache.single ? &*cache.single : nullptr;
}

bool ConnectionLeg::reaches_single(size_t light, float t) {
  if (is_empty() || !context_->settings().single) return false;
  const PerLight& cache = aim_at(light);
  return cache.varies && cache.base->pdf_t(t) > 0;
}

const DoubleScatteringDistance* ConnectionLeg::dual_base(size_t light) {
  if (is_empty() || !context_->settings().dual) return nullptr;
  PerLight& cache = aim_at(light);
  if (!cache.base) return nullptr;
  if (!cache.dual_base)
    cache.dual_base.emplace(context_->tables(*proxy_.first_medium()),
                            cache.base->segment());
  return cache.dual_base->integral() > 0 ? &*cache.dual_base : nullptr;
}

const ConnectionLeg::Double* ConnectionLeg::dual(size_t light) {
  const DoubleScatteringDistance* base = dual_base(light);
  if (!base) return nullptr;
  if (!cache_->dual)
    cache_->dual.emplace(*base, weights(base->taps<8>(), false), floor_share);
  return &*cache_->dual;
}

const ConnectionLeg::Forced* ConnectionLeg::forced(size_t light) {
  if (is_empty() || !(proxy_.collision_share() > 0)) return nullptr;
  if (forced_ && forced_->first == light) return &forced_->second;
  const CollisionDistance base(proxy_, t_max_);
  auto factors = DistanceWeights<32>::ones();
  if (const LightVisibility* visibility = context_->visibility()) {
    const std::array<float, 64> taps = base.taps<64>();
    const float footprint = (taps.back() - taps.front()) / 64;
    visibility->multiply(light, ray_, taps, footprint, factors.values);
    if (!is_homogeneous())
      visibility->multiply_transmittance(light, ray_, base.taps<32>(), factors.values);
  }
  forced_.emplace(light, Forced(base, factors, floor_share_of_visible));
  return &forced_->second;
}

const LightProbabilities& ConnectionLeg::forced_lights() {
  if (forced_lights_) return *forced_lights_;
  const LightChoice& choice = context_->light_choice();
  const bool leaves_far_ones = context_->settings().min_distance_ratio > 1;
  forced_lights_ = leaves_far_ones ? choice.at_point(ray_.at(proxy_.distance_to(0.5f)))
                                   : choice.at_infinity();
  return *forced_lights_;
}

std::optional<SelectedLight> ConnectionLeg::select_forced_light(float u) {
  return forced_lights().select(context_->scene().lights(), u);
}

float ConnectionLeg::forced_light_probability(size_t light) {
  return forced_lights().probability(light);
}

TYNDALL_VECTOR_CLONES
std::optional<ConnectionLeg::Lit> ConnectionLeg::lit(Vec3 p, Vec3 ng, Vec3 to_light) const {
  if (is_empty()) return std::nullopt;
  const EquiangularSampling base(ray_, p, proxy_.t_min(), t_max_);
  if (!(base.integral() > 0)) return std::nullopt;
  const DistanceTaps<16> taps = base.taps<16>();
  DistanceWeights<16> factors = weights(taps, true);
  const Vec3 n = dot(ng, to_light) > 0 ? ng : -ng;
  const float c0 = dot(ray_.o - p, n), c1 = dot(ray_.d, n);
  for (size_t i = 0; i < 16; ++i)
    factors.values[i] *= std::max((c0 + c1 * taps.t[i]) / taps.distance[i], 0.0f);
  return Lit(base, factors, floor_share);
}

bool ConnectionLeg::reaches_dual(const LegStart& x, size_t light) {
  const DoubleScatteringDistance* base = x.is_in_medium ? dual_base(light) : nullptr;
  return base && base->pdf_t(x.t) > 0;
}

}  // namespace tyndall
