// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "tyndall/image/splat_canvas.h"
#include "tyndall/integrators/free_flight.h"
#include "tyndall/integrators/particle_source.h"
#include "tyndall/integrators/render_settings.h"
#include "tyndall/integrators/vertex.h"

namespace tyndall {

/// What all particles of a render share.
struct ParticleRules {
  int max_depth;  ///< as RenderSettings has them
  ScatteringOrders orders;
  bool is_chromatic;  ///< some medium differs between the colour channels
};

/// One particle in the making: a random walk out of a light to a specular surface and on
/// from there, whose vertices are connected to the camera. Its steps are its member
/// functions.
class Particle {
 public:
  Particle(const Scene& scene, const ParticleRules& rules, const ParticleSource& source,
           Sampler& sampler);

  /// Leaves the light and flies to a specular surface; what would scatter before is left to
  /// other techniques. False if it meets none. `count` particles are traced in all, for one
  /// sample of each pixel.
  bool emit(float count);
  /// Draws the next direction and plays Russian roulette. False if the particle ends.
  bool scatter();
  /// Flies to the next vertex. False if the particle ends.
  bool advance();
  /// Connects the vertex to the camera.
  void connect(const SplatCanvas& canvas, std::vector<Splat>& splats);
  int rays() const { return rays_; }  ///< traced so far

 private:
  bool arrive();
  bool survives_roulette();
  Rgb scattered_to(Vec3 w) const;

  const Scene& scene_;
  const ParticleRules& rules_;
  const ParticleSource& source_;
  Sampler& sampler_;
  RandomStream tracking_;

  Ray ray_;
  const Medium* medium_ = nullptr;
  Carried carried_;
  float initial_ = 1;  // largest component that was emitted
  int hero_ = 0;
  int rays_ = 0;
  int depth_ = 0;    // vertices so far
  int order_ = 0;    // of them, in media
  float ratio_ = 0;  // ParticleRatio of the path so far
  std::optional<Vertex> vertex_;
};

}  // namespace tyndall
