// SPDX-License-Identifier: Apache-2.0
#include "support/surfaces.h"

namespace tyndall::test {

Surface sphere_boundary(Vec3 center, float radius, int inside, int outside) {
  return {.shape = Sphere{.world_from_sphere = Transform::translate(center),
                          .radius = radius,
                          .z_min = -radius,
                          .z_max = radius,
                          .phi_max = 2 * pi,
                          .flip_normals = false},
          .material = InterfaceBsdf{},
          .media = {.inside = inside, .outside = outside, .is_stated = true},
          .emission = std::nullopt,
          .name = "boundary sphere"};
}

Surface box_boundary(Vec3 min, Vec3 max, int inside, int outside) {
  const Bounds3 box{min, max};
  std::vector<Vec3> positions;
  for (int i = 0; i < 8; ++i) positions.push_back(box.corner(i));
  std::vector<Vec3i> triangles{{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6},
                               {0, 1, 5}, {0, 5, 4}, {2, 6, 7}, {2, 7, 3},
                               {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return {.shape = TriangleMesh(std::move(positions), std::move(triangles), {}, {}, false),
          .material = InterfaceBsdf{},
          .media = {.inside = inside, .outside = outside, .is_stated = true},
          .emission = std::nullopt,
          .name = "boundary box"};
}

PerspectiveCamera camera_at(Vec3 eye) {
  PerspectiveCamera::Settings s;
  s.world_from_camera = Transform::look_at(eye, eye + Vec3{0, 0, 1}, {0, 1, 0})->inverse();
  s.fov = 40;
  return {s, {16, 16}};
}

}  // namespace tyndall::test
