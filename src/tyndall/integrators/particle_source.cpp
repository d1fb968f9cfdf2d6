// SPDX-License-Identifier: Apache-2.0
#include "tyndall/integrators/particle_source.h"

#include <numeric>
#include <variant>

#include "tyndall/integrators/leg.h"
#include "tyndall/sampling/sampler.h"

namespace tyndall {
namespace {

constexpr size_t max_bytes = size_t{4} << 20;
// Rays before and after the first have been learned from, that tell where particles are to
// go.
constexpr uint32_t pilot_rays = 1 << 14;

void extend(Bounds3& box, const std::vector<Surface>& surfaces, const Transform& to_world) {
  for (const Surface& surface : surfaces)
    if (ParticleSource::is_specular(surface))
      box.extend(to_world.bounds(bounds(surface.shape)));
}

// Of all specular surfaces; empty if there are none.
Bounds3 bounds_of_specular(const SceneDescription& description) {
  Bounds3 box;
  extend(box, description.surfaces, Transform());
  for (const ObjectInstance& instance : description.instances)
    extend(box, description.objects[instance.object], instance.world_from_object);
  return box;
}

}  // namespace

bool ParticleSource::is_specular(const Surface& surface) {
  const auto* conductor = std::get_if<ConductorBsdf>(&surface.material);
  const auto* dielectric = std::get_if<DielectricBsdf>(&surface.material);
  return (conductor && conductor->is_specular()) ||
         (dielectric && dielectric->is_specular());
}

ParticleSource::ParticleSource(const Scene& scene, uint64_t seed) : scene_(&scene) {
  if (bounds_of_specular(scene.description()).is_empty()) return;
  add_emitters();
  std::vector<float> powers;
  for (const Emitter& emitter : emitters_)
    powers.push_back(emitter.square ? emitter.square->power(scene.bounds()) : 0);
  const float power = std::accumulate(powers.begin(), powers.end(), 0.0f);
  if (!(power > 0)) return;
  learned_.emplace(powers, max_bytes);
  learn(hash(seed, uint64_t{1}), power);
  learn(hash(seed, uint64_t{2}), power);
}

void ParticleSource::add_emitters() {
  const Bounds3 box = bounds_of_specular(scene_->description());
  for (const Light& light : scene_->lights()) {
    const auto* hidden = std::get_if<HiddenAreaLight>(&light.variant());
    lights_.push_back(hidden ? Light(hidden->area) : light);
  }
  for (size_t i = 0; i < lights_.size(); ++i) {
    Emitter& emitter = emitters_.emplace_back();
    emitter.square = EmissionSquare::of(lights_[i], box, scene_->bounds());
    emitter.is_hit_by_walks =
        std::holds_alternative<AreaLight>(scene_->lights()[i].variant());
    if (emitter.square) find_media(emitter, lights_[i].is_infinite());
    // Fog without end lets nothing through.
    if (lights_[i].is_infinite() && emitter.media[0]) emitter.square.reset();
  }
}

// A light is taken to be in one medium, on each side.
void ParticleSource::find_media(Emitter& emitter, bool is_infinite) const {
  const EmittedRay ray = emitter.square->emit({0.5f, 0.5f}, {0.5f, 0.5f});
  const Vec3 ng = ray.on.ng;
  if (length_squared(ng) > 0) {
    const Vec3 p = ray.on.p;
    emitter.media = {scene_->surrounding_medium(offset_origin(p, ng, ng)),
                     scene_->surrounding_medium(offset_origin(p, ng, -ng))};
    return;
  }
  emitter.media.fill(is_infinite ? scene_->medium_at_infinity(-ray.ray.d)
                                 : scene_->surrounding_medium(ray.ray.o));
}

void ParticleSource::learn(uint64_t seed, float power) {
  for (uint32_t i = 0; i < pilot_rays; ++i) {
    Sampler sampler(SamplerKind::sobol, seed, {-1, -1}, i);
    const float u_light = sampler.next_1d();
    const SquaresSample choice = learned_->sample(u_light, sampler.next_2d());
    const std::optional<EmittedRay> emitted = emit(choice, sampler.next_2d());
    if (!emitted) continue;
    const std::optional<SurfaceHit> hit = scene_->intersect_opaque(emitted->ray, infinity);
    if (!hit || !is_specular(*hit->surface)) continue;
    is_useful_ = true;
    learned_->record(
        choice, luminance(emitted->emission) / (emitted->pdf * choice.density * power));
  }
  learned_->update();
}

std::optional<EmittedRay> ParticleSource::emit(const SquaresSample& choice,
                                               Vec2 u_point) const {
  const std::optional<EmissionSquare>& square = emitters_[choice.index].square;
  if (!square || !(choice.density > 0)) return std::nullopt;
  const EmittedRay emitted = square->emit(choice.p, u_point);
  if (!(emitted.pdf > 0) || is_black(emitted.emission)) return std::nullopt;
  return emitted;
}

std::optional<EmittedParticle> ParticleSource::emit(float u_light, Vec2 u_direction,
                                                    Vec2 u_point) const {
  SquaresSample choice = learned_->sample(u_light, u_direction);
  const std::optional<EmissionSquare>& square = emitters_[choice.index].square;
  if (square && !square->is_invertible())  // directions are all alike
    choice = {choice.index, u_direction, learned_->probability(choice.index)};
  const std::optional<EmittedRay> emitted = emit(choice, u_point);
  if (!emitted) return std::nullopt;
  const Emitter& emitter = emitters_[choice.index];
  const bool is_behind = dot(emitted->on.ng, emitted->ray.d) < 0;
  return EmittedParticle{.ray = emitted->ray,
                         .medium = emitter.media[is_behind ? 1 : 0],
                         .beta = emitted->emission / (emitted->pdf * choice.density),
                         .density = density(choice.index, emitted->ray.d, emitted->on.p)};
}

float ParticleSource::density(size_t light, Vec3 w, Vec3 p) const {
  const Emitter& emitter = emitters_[light];
  if (!emitter.square) return 0;
  if (!emitter.is_hit_by_walks) return infinity;
  const bool is_learned = emitter.square->is_invertible();
  const float chosen = is_learned ? learned_->density(light, emitter.square->invert(w, p))
                                  : learned_->probability(light);
  return chosen * emitter.square->density(p, -w, 0);
}

}  // namespace tyndall
