// SPDX-License-Identifier: Apache-2.0
// Light that lamps send over specular surfaces, which particles find as well.
#include "tyndall/integrators/particle_ratio.h"
#include "tyndall/integrators/particle_tracer.h"
#include "tyndall/integrators/path.h"

namespace tyndall {

// Of the path up to the vertex that is left by `s`. Particles are not seen in mirrors, nor
// through glass.
float Path::particle_ratio(const DirectionSample& s) const {
  const bool is_first = depth_ == 1;
  if (s.is_specular) return is_first ? 0 : particle_ratio_ * ParticleRatio::specular(s.eta);
  const Vec3 wo = vertex_->wo();
  if (is_first)
    return ParticleRatio::first(
        scene_.camera(), *vertex_,
        {.to_camera = wo, .to_light = s.wi, .pdf_to_camera = 0, .pdf_to_light = s.pdf},
        t_vertex_);
  return particle_ratio_ *
         ParticleRatio::next(*vertex_, {.to_camera = wo,
                                        .to_light = s.wi,
                                        .pdf_to_camera = vertex_->pdf_from(s.wi),
                                        .pdf_to_light = s.pdf});
}

// Of the walk that has hit a lamp by way of a specular vertex, or at once.
float Path::weight_beside_particles(const SurfaceHit& hit) const {
  if (!rules_.particles || !(particle_ratio_ > 0)) return 1;
  return walk_weight(particle_ratio_ *
                     rules_.particles->density(hit.light_index, -ray_.d, hit.point.p));
}

}  // namespace tyndall
