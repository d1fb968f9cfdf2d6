// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>

#include "tyndall/integrators/connection_budget.h"
#include "tyndall/integrators/connection_leg.h"
#include "tyndall/integrators/vertex.h"

namespace tyndall {

/// The light sample at the end of a path, as all techniques see it.
struct LightEnd {
  size_t light;
  float probability;  ///< of next event estimation to choose the light; of no account
                      ///< where a connection makes the path
  float pdf;  ///< of its point, from the last vertex, w.r.t. solid angle; one if delta
  float pdf_direction;  ///< of the walk to hit that point [1/sr]; zero if delta
  Vec3 to_light;        ///< unit
  float distance;
};

/// Densities of the last part of a path, up to a common factor: one for each technique that
/// makes it, times how often that is tried. Their shares are the weights of the balance
/// heuristic [Veach97]. They come from proxies,
/// and are functions of the path's vertices and of the light points alone, so that the
/// weights of a path sum to one whatever made it.
///
/// Where a dual connection can make a path, single connections and next event estimation
/// leave it to that, and where a single connection can, next event estimation does: their
/// densities are zero then, and where a collision is forced. Each of them covers all that
/// the next one does, with less variance; doing both costs rays that buy nothing.
struct TailDensities {
  float direct = 0;  ///< a walk, then next event estimation
  float forced = 0;  ///< the same after a forced collision
  float hit = 0;     ///< a walk that hits the light
  float single = 0;  ///< a walk up to the vertex before the last, then a single connection
  float glow = 0;    ///< a walk to the surface before the last vertex, then to its glow
  float dual = 0;    ///< a walk up to two vertices before the last, then a dual connection
  /// a walk, then a connection to a point that light reached over 1, 2 ... surfaces
  std::array<float, max_lit_surfaces> lit{};

  float weight(float technique) const {
    float sum = direct + forced + hit + single + glow + dual;
    for (const float density : lit) sum += density;
    return technique > 0 && sum < infinity ? technique / sum : 0;
  }
};

/// How often connections make a path of so many scattering vertices.
struct TailCounts {
  const ConnectionCounts* counts;
  int vertices;
  /// With which a walk reaches the surface that the camera sees, through the media before
  /// it; connections from there are made for certain.
  float probability_of_first = 1;

  /// With which a walk reaches the vertex before the last `added` ones, which is one on a
  /// surface or in a medium: certain, but for the surface that the camera sees.
  float probability_of_reaching(int added, bool is_on_surface) const {
    return vertices == added + 1 && is_on_surface ? probability_of_first : 1;
  }
  /// Of those that add the last `added` vertices. Those left to chance count as one: were
  /// their shares as small as their chances, what walks find near lamps would vary more.
  float operator()(Effort effort, int added) const {
    return std::max((*counts)(effort, vertices - added), 1.0f);
  }
  /// See ConnectionCounts.
  size_t lit_place(Effort effort, int added) const {
    return counts->lit_place(effort, vertices - added);
  }
};

/// The start of a leg at a vertex that stands at distance t of the leg before.
LegStart start_of_leg(const Vertex& vertex, float t, float pdf_direction, bool is_specular);

/// A path whose last vertex lies in a medium: `before` (leg to x), x, `leg` (from x), and
/// the last vertex at distance t of `leg`.
TailDensities tail_densities(const ConnectionContext& context, const TailCounts& counts,
                             ConnectionLeg& before, const LegStart& x, ConnectionLeg& leg,
                             float t, const LightEnd& end);

/// A path whose last vertex `p` lies on a surface that sees the light under an angle of
/// cosine `cos_light`; `chain` holds the edges of the walk to that surface.
TailDensities surface_tail_densities(const ConnectionContext& context,
                                     const TailCounts& counts, const LitChain& chain,
                                     Vec3 p, const LightEnd& end, float cos_light);

}  // namespace tyndall
