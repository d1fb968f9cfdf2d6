// SPDX-License-Identifier: Apache-2.0
#include "tyndall/integrators/vertex.h"

#include "tyndall/integrators/lit_surface.h"

namespace tyndall {

Vertex::Vertex(Vec3 p, Vec3 wo, const Medium* medium) : p_(p), wo_(wo), medium_(medium) {
  assert(medium);
}

Vertex::Vertex(const SurfaceHit& hit, Vec3 wo, const Medium* medium)
    : p_(hit.point.p),
      wo_(wo),
      medium_(medium),
      hit_(hit),
      bsdf_(std::in_place, hit.surface->material, hit.point.ng, hit.point.ns) {}

Rgb Vertex::eval(Vec3 wi) const {
  return bsdf_ ? bsdf_->eval(wo_, wi) : medium_->eval_phase(p_, wo_, wi);
}

float Vertex::pdf(Vec3 wi) const {
  return bsdf_ ? bsdf_->pdf(wo_, wi) : medium_->pdf_phase(p_, wo_, wi);
}

Rgb Vertex::eval_from(Vec3 w) const {
  return bsdf_ ? bsdf_->eval(w, wo_) : medium_->eval_phase(p_, w, wo_);
}

float Vertex::pdf_from(Vec3 w) const {
  return bsdf_ ? bsdf_->pdf(w, wo_) : medium_->pdf_phase(p_, w, wo_);
}

std::optional<DirectionSample> Vertex::sample(Sampler& sampler) const {
  if (!bsdf_) {
    const std::optional<MediumDirection> s =
        medium_->sample_phase(p_, wo_, sampler.next_2d());
    if (!s) return std::nullopt;
    return DirectionSample{s->wi, s->value, s->pdf, false, 1};
  }
  float u_lobe = 0;
  if (bsdf_->chooses_lobe())
    u_lobe = sampler.next_1d();
  else
    sampler.skip();
  const std::optional<BsdfSample> s = bsdf_->sample(wo_, u_lobe, sampler.next_2d());
  if (!s || !(s->pdf > 0)) return std::nullopt;
  return DirectionSample{s->wi, s->value, s->pdf, s->is_specular, s->eta};
}

bool Vertex::is_specular() const { return bsdf_ && bsdf_->is_specular(); }

Rgb Vertex::albedo() const {
  if (bsdf_) return bsdf_->albedo(wo_);
  const MediumProperties properties = medium_->at(p_);
  return safe_divide(properties.sigma_s, properties.sigma_t());
}

Vec3 Vertex::normal() const { return hit_ ? hit_->point.ns : Vec3{}; }

bool Vertex::can_be_lit() const {
  return hit_ && LitSurfaceSampling::finds(*hit_->surface);
}

Ray Vertex::spawn(Vec3 wi) const {
  return {hit_ ? offset_origin(p_, hit_->point.ng, wi) : p_, wi};
}

const Medium* Vertex::medium_towards(const Scene& scene, Vec3 wi) const {
  // Light that stays on its side of a surface stays in its medium.
  if (!hit_ || dot(wi, hit_->point.ng) * dot(wo_, hit_->point.ng) > 0) return medium_;
  return scene.medium_across(*hit_, wi, medium_);
}

}  // namespace tyndall
