// SPDX-License-Identifier: Apache-2.0
#include "tyndall/loader/area_light_power.h"

#include <algorithm>
#include <cmath>

namespace tyndall::loader {
namespace {

constexpr float area_tolerance = 1e-4f;  // relative; below it pieces count as equal

float triangle_area(const TriangleMesh& mesh, Vec3i t) {
  const std::vector<Vec3>& p = mesh.positions();
  const Vec3 a = p[static_cast<size_t>(t.x)];
  return 0.5f *
         length(cross(p[static_cast<size_t>(t.y)] - a, p[static_cast<size_t>(t.z)] - a));
}

AreaEmission emission_of(const AreaLightRequest& light, float area) {
  const float k = (light.two_sided ? 2 : 1) * pi * area;
  return {k > 0 ? light.L * (light.power / k) : Rgb{}, light.two_sided};
}

bool are_equal(const std::vector<float>& areas) {
  const auto [min, max] = std::minmax_element(areas.begin(), areas.end());
  return *max - *min <= area_tolerance * *max;
}

std::vector<EmissivePart> parts_of(const TriangleMesh& mesh,
                                   const AreaLightRequest& light) {
  std::vector<float> areas;
  for (const Vec3i& t : mesh.triangles()) areas.push_back(triangle_area(mesh, t));
  if (areas.empty() || are_equal(areas))
    return {{mesh, emission_of(light, areas.empty() ? 0 : areas[0])}};
  std::vector<EmissivePart> parts;
  for (size_t i = 0; i < areas.size(); ++i) {
    const Vec3i t = mesh.triangles()[i];
    std::vector<Vec3> corners;
    for (const int v : {t.x, t.y, t.z})
      corners.push_back(mesh.positions()[static_cast<size_t>(v)]);
    parts.push_back({TriangleMesh(std::move(corners), {{0, 1, 2}}, {}, {}, false),
                     emission_of(light, areas[i])});
  }
  return parts;
}

std::vector<EmissivePart> parts_of(const BilinearMesh& mesh,
                                   const AreaLightRequest& light) {
  std::vector<EmissivePart> parts;
  for (const std::array<int, 4>& patch : mesh.patches) {
    BilinearMesh part{{}, {{0, 1, 2, 3}}, {}, {}, mesh.flip_normals};
    for (const int v : patch)
      part.positions.push_back(mesh.positions[static_cast<size_t>(v)]);
    const float part_area = area(Shape(part));
    parts.push_back({std::move(part), emission_of(light, part_area)});
  }
  return parts;
}

}  // namespace

std::vector<EmissivePart> with_emission(Shape shape,
                                        const std::optional<AreaLightRequest>& light) {
  std::vector<EmissivePart> whole;
  if (!light || !(light->power > 0)) {
    std::optional<AreaEmission> emission;
    if (light) emission = AreaEmission{light->L, light->two_sided};
    whole.push_back({std::move(shape), emission});
    return whole;
  }
  if (const auto* triangles = std::get_if<TriangleMesh>(&shape))
    return parts_of(*triangles, *light);
  if (const auto* patches = std::get_if<BilinearMesh>(&shape))
    return parts_of(*patches, *light);
  const AreaEmission emission = emission_of(*light, area(shape));
  whole.push_back({std::move(shape), emission});
  return whole;
}

}  // namespace tyndall::loader
