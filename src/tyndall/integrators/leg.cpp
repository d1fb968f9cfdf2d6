// SPDX-License-Identifier: Apache-2.0
#include "tyndall/integrators/leg.h"

#include <type_traits>

#include "tyndall/media/glow.h"

namespace tyndall {
namespace {

// What a function returns, made where it is to stay: `optional.emplace(Made{f})` copies
// nothing.
template <typename F>
struct Made {
  F make;
  operator std::invoke_result_t<F>() const { return make(); }  // NOLINT: the point of it
};

}  // namespace

Leg::Leg(const Scene& scene, const Ray& ray, const Medium* medium)
    : scene_(&scene), ray_(ray), medium_(medium) {}

void Leg::trace() {
  if (spans_.empty()) found_ = scene_->trace(ray_, t_max_, medium_, spans_);
}

const Leg::Span* Leg::span(size_t i) {
  trace();
  return i < spans_.size() ? &spans_[i] : nullptr;
}

const SurfaceHit* Leg::end() {
  trace();
  if (found_ && !end_) end_.emplace(Made{[&] { return scene_->resolve(ray_, *found_); }});
  return end_ ? &*end_ : nullptr;
}

float Leg::length() {
  trace();
  return spans_.back().t_max;
}

const Medium* Leg::end_medium() {
  trace();
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

Rgb transmittance_along(Leg& leg, float t, RandomStream& rng) {
  Rgb product(1);
  for (size_t i = 0; const Leg::Span* span = leg.span(i); ++i) {
    if (span->t_min >= t) break;
    if (!span->medium) continue;
    const Ray rest{leg.ray().at(span->t_min), leg.ray().d};
    product *=
        estimate_span(*span->medium, rest, std::min(t, span->t_max) - span->t_min, rng);
  }
  return product;
}

Passage passage(const Scene& scene, const Ray& ray, float t_max, const Medium* medium,
                RandomStream& rng) {
  MediumSpans spans;
  const Medium* end = scene.media_along(ray, t_max, medium, spans);
  Rgb product(1);
  for (const MediumSpan& span : spans) {
    if (!span.medium) continue;
    const Ray rest{ray.at(span.t_min), ray.d};
    product *= estimate_span(*span.medium, rest, span.t_max - span.t_min, rng);
    if (is_black(product)) break;
  }
  return {product, end};
}

const Medium* medium_at(const Scene& scene, Vec3 p) {
  const Vec3 eye = scene.camera().position();
  const float distance = length(p - eye);
  if (!(distance > 0)) return scene.camera_medium();
  MediumSpans spans;
  return scene.media_along({eye, (p - eye) / distance}, distance, scene.camera_medium(),
                           spans);
}

}  // namespace tyndall
