// SPDX-License-Identifier: Apache-2.0
#include "tyndall/integrators/leg.h"

#include "tyndall/media/glow.h"

namespace tyndall {
namespace {

// More crossings than any real scene has: a ray caught between coincident surfaces gives
// up.
constexpr size_t max_spans = 4096;

bool is_boundary(const FoundSurface& found) {
  return std::holds_alternative<InterfaceBsdf>(found.surface->material);
}

}  // namespace

Leg::Leg(const Scene& scene, const Ray& ray, const Medium* medium)
    : scene_(&scene), ray_(ray), last_(ray), medium_(medium) {}

void Leg::trace_span() {
  if (found_) cross_boundary();
  found_ = scene_->find(last_, infinity);
  const float t_end = found_ ? t_ + found_->hit.t : far_distance;
  spans_.push_back({t_, t_end, medium_});
  t_ = t_end;
  if (spans_.size() >= max_spans && found_ && is_boundary(*found_)) found_.reset();
  is_complete_ = !found_ || !is_boundary(*found_);
}

void Leg::cross_boundary() {
  const SurfaceHit hit = scene_->resolve(last_, *found_);
  medium_ = scene_->medium_across(hit, ray_.d, medium_);
  last_.o = offset_origin(hit.point.p, hit.point.ng, ray_.d);
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
  if (found_ && !end_) {
    end_ = scene_->resolve(last_, *found_);
    end_->t = t_;
  }
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

Rgb glow_along(Leg& leg, RandomStream& rng) {
  size_t count = 0;  // of the spans up to the last that glows
  for (size_t i = 0; const Leg::Span* span = leg.span(i); ++i)
    if (span->medium && span->medium->is_emissive()) count = i + 1;
  Rgb sum, T(1);
  for (size_t i = 0; i < count && !is_black(T); ++i) {
    const Leg::Span& span = *leg.span(i);
    if (!span.medium) continue;
    const Ray rest{leg.ray().at(span.t_min), leg.ray().d};
    const float length = span.t_max - span.t_min;
    if (span.medium->is_emissive())
      sum += estimate_glow(*span.medium, rest, length, rng, T);
    else
      T *= estimate_span(*span.medium, rest, length, rng);
  }
  return sum;
}

Passage passage(const Scene& scene, const Ray& ray, float t_max, const Medium* medium,
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
  return {product, medium};
}

}  // namespace tyndall
