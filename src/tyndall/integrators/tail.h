// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tyndall/integrators/connection_leg.h"

namespace tyndall {

/// Where a leg begins, as far as the densities of other techniques need to know.
struct LegStart {
  Vec3 p;
  float t = 0;                 ///< of p along the leg before
  float pdf_direction = 1;     ///< with which the walk turns into the leg [1/sr]
  bool is_specular = true;     ///< the camera, or a Dirac delta: the direction has no density
  bool is_in_medium = false;
};

/// The light sample at the end of a path, as all techniques see it.
struct LightEnd {
  size_t light;
  float probability;  ///< of next event estimation to choose the light
  float pdf;          ///< of its point, from the last vertex, w.r.t. solid angle; one if delta
  float pdf_direction;  ///< of the walk to hit that point [1/sr]; zero if delta
};

/// Densities of the last part of a path, up to a common factor: one for each technique that
/// could have made it. Their shares are the weights of the balance heuristic. They come from
/// proxies, and are functions of the path's vertices and of the light points alone, so that
/// the weights of a path sum to one whatever made it.
struct TailDensities {
  float direct = 0;  ///< a walk, then next event estimation
  float hit = 0;     ///< a walk that hits the light
  float single = 0;  ///< a walk up to the vertex before the last, then a single connection
  float dual = 0;    ///< a walk up to two vertices before the last, then a dual connection

  float weight(float technique) const {
    const float sum = direct + hit + single + dual;
    return technique > 0 && sum < infinity ? technique / sum : 0;
  }
};

/// A path whose last vertex lies in a medium: `before` (leg to x), x, `leg` (from x), and the
/// last vertex at distance t of `leg`.
TailDensities tail_densities(const ConnectionContext& context, ConnectionLeg& before,
                             const LegStart& x, ConnectionLeg& leg, float t,
                             const LightEnd& end);

}  // namespace tyndall
