// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tyndall/integrators/vertex.h"
#include "tyndall/scene/camera.h"

namespace tyndall {

/// How many times as likely particles out of lights make a path as walks from the camera:
/// a product over the path's vertices, with one more factor of the light, for the balance
/// heuristic between the two. Transmittances, collisions and roulette are left out, and
/// distances cancel; docs/techniques.md derives it. Walks and particles multiply the same
/// factors, in opposite orders.
class ParticleRatio {
 public:
  /// Directions at a vertex, unit, and the densities of going there [1/sr].
  struct Turn {
    Vec3 to_camera, to_light;
    float pdf_to_camera, pdf_to_light;
  };

  /// Of the vertex that the camera sees at `distance`: only walks choose a direction there.
  static float first(const PerspectiveCamera& camera, const Vertex& vertex,
                     const Turn& turn, float distance) {
    return sqr(distance) * cosines(vertex, turn) /
           (camera.pixels_per_solid_angle(-turn.to_camera) * turn.pdf_to_light);
  }
  /// Of any other vertex that is not specular.
  static float next(const Vertex& vertex, const Turn& turn) {
    if (vertex.is_in_medium()) return 1;  // phase functions are symmetric
    return cosines(vertex, turn) * turn.pdf_to_camera / turn.pdf_to_light;
  }
  /// Of a specular vertex, that a walk crosses with this relative index of refraction.
  static float specular(float eta) { return 1 / sqr(eta); }

 private:
  static float cosines(const Vertex& vertex, const Turn& turn) {
    if (vertex.is_in_medium()) return 1;
    return abs_dot(vertex.ng(), turn.to_light) / abs_dot(vertex.ng(), turn.to_camera);
  }
};

/// The weight of the balance heuristic for what walks, and for what particles find.
inline float walk_weight(float ratio) { return 1 / (1 + ratio); }
inline float particle_weight(float ratio) {
  return ratio > 0 ? 1 / (1 + 1 / ratio) : 0;  // of infinity, one
}

}  // namespace tyndall
