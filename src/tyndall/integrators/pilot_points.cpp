// SPDX-License-Identifier: Apache-2.0
#include "tyndall/integrators/pilot_points.h"

#include "tyndall/integrators/leg_proxy.h"
#include "tyndall/math/frame.h"
#include "tyndall/sampling/warps.h"

namespace tyndall {
namespace {

constexpr int walks = 1024, legs_per_walk = 3, points_per_leg = 4;
// Points lie where the proxy lets at least this share of the light through.
constexpr float least_transmittance = 0.05f;

void add_points(const LegProxy& proxy, const Ray& ray, RandomStream& random,
                std::vector<Vec3>& points) {
  const float t_min = proxy.t_min();
  const float way = proxy.distance_to(least_transmittance) - t_min;
  if (!(way > 0 && way < far_distance)) return;
  for (int i = 0; i < points_per_leg; ++i) {
    const float share = (static_cast<float>(i) + random.next_1d()) / points_per_leg;
    points.push_back(ray.at(t_min + share * way));
  }
}

// One walk: scattered evenly to all sides in media, and off surfaces.
void walk(const Scene& scene, RandomStream& random, std::vector<Vec3>& points) {
  const auto resolution = scene.camera().resolution();
  const Vec2 u = random.next_2d();
  Ray ray = scene.camera().ray(
      {u.x * static_cast<float>(resolution.x), u.y * static_cast<float>(resolution.y)},
      {0.5f, 0.5f});
  const Medium* medium = scene.camera_medium();
  for (int i = 0; i < legs_per_walk; ++i) {
    Leg leg(scene, ray, medium);
    const LegProxy proxy(leg);
    if (!proxy.is_empty()) add_points(proxy, ray, random, points);
    const float level = 1 - random.next_1d();
    const Vec2 direction = random.next_2d();
    const bool collides =
        !proxy.is_empty() && level > 0 && proxy.transmittance(proxy.t_max()) < level;
    if (collides) {
      const float t = proxy.distance_to(level);
      medium = proxy.medium_at(t);
      ray = {ray.at(t), sample_uniform_sphere(direction)};
    } else {
      const SurfaceHit* hit = leg.end();
      if (!hit) return;
      medium = leg.end_medium();
      const Vec3 n = dot(hit->point.ng, ray.d) < 0 ? hit->point.ng : -hit->point.ng;
      const Vec3 d = Frame::from_z(n).to_world(sample_cosine_hemisphere(direction));
      ray = {offset_origin(hit->point.p, hit->point.ng, d), d};
    }
  }
}

}  // namespace

std::vector<Vec3> pilot_points(const Scene& scene) {
  std::vector<Vec3> points;
  for (uint64_t i = 0; i < walks; ++i) {
    RandomStream random(hash(uint64_t{1}, i));
    walk(scene, random, points);
  }
  return points;
}

}  // namespace tyndall
