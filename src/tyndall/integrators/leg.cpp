// SPDX-License-Identifier: Apache-2.0
#include "tyndall/integrators/leg.h"

namespace tyndall {
namespace {

// More crossings than any real scene has: a ray caught between coincident surfaces gives
// up.
constexpr size_t max_spans = 4096;

bool is_boundary(const SurfaceHit& hit) {
  return std::holds_alternative<InterfaceBsdf>(hit.surface->material);
}

}  // namespace

Leg::Leg(const Scene& scene, const Ray& ray, const Medium* medium)
    : scene_(&scene), ray_(ray), origin_(ray.o), medium_(medium) {}

void Leg::trace_span() {
  const std::optional<SurfaceHit> hit = scene_->intersect({origin_, ray_.d}, infinity);
  const float t_end = hit ? t_ + hit->t : far_distance;
  spans_.push_back({t_, t_end, medium_});
  t_ = t_end;
  if (!hit || spans_.size() >= max_spans) {
    is_complete_ = true;
  } else if (is_boundary(*hit)) {
    medium_ = scene_->medium_across(*hit, ray_.d, medium_);
    origin_ = offset_origin(hit->point.p, hit->point.ng, ray_.d);
  } else {
    end_ = hit;
    end_->t = t_end;
    is_complete_ = true;
  }
}

void Leg::trace_all() {
  while (!is_complete_) trace_span();
}

const Leg::Span* Leg::span(size_t i) {
  while (i >= spans_.size() && !is_complete_) trace_span();
  return i < spans_.size() ? &spans_[i] : nullptr;
}

const SurfaceHit* Leg::end() {
  trace_all();
  return end_ ? &*end_ : nullptr;
}

float Leg::length() {
  trace_all();
  return spans_.back().t_max;
}

const Medium* Leg::end_medium() {
  trace_all();
  return medium_;
}

Rgb transmittance(const Scene& scene, const Ray& ray, float t_max, const Medium* medium,
                  RandomStream& rng) {
  Rgb product(1);
  Ray rest = ray;
  for (size_t i = 0; i < max_spans; ++i) {
    const std::optional<SurfaceHit> hit = scene.intersect_boundary(rest, t_max);
    const float t = hit ? hit->t : t_max;
    if (medium) product *= estimate_span(*medium, rest, t, rng);
    if (!hit || is_black(product)) break;
    medium = scene.medium_across(*hit, ray.d, medium);
    rest.o = offset_origin(hit->point.p, hit->point.ng, ray.d);
    t_max -= t;
  }
  return product;
}

}  // namespace tyndall
