// SPDX-License-Identifier: Apache-2.0
#include "tyndall/loader/area_light_power.h"

#include <algorithm>
#include <cmath>

namespace tyndall::loader {
namespace {

constexpr float area_tolerance = 1e-4f;  // relative; below it pieces count as equal

AreaEmission emission_of(const AreaLightRequest& light, float area) {
  const float k = (light.two_sided ? 2 : 1) * pi * area;
  const Rgb L = light.L * (light.power / k);
  return {is_finite(L) ? L : Rgb{}, light.two_sided};  // not so without area
}

// Precondition: not empty.
bool are_equal(const std::vector<float>& areas) {
  const auto [min, max] = std::minmax_element(areas.begin(), areas.end());
  return *max - *min <= area_tolerance * *max;
}

// One triangle of the mesh, facing as it does there.
TriangleMesh triangle(const TriangleMesh& mesh, size_t i) {
  const Vec3i t = mesh.triangles()[i];
  std::vector<Vec3> p;
  for (const int v : {t.x, t.y, t.z}) p.push_back(mesh.positions()[static_cast<size_t>(v)]);
  const Vec3 ng = mesh.point(static_cast<uint32_t>(i), {0.25f, 0.25f}).ng;
  const bool is_flipped = dot(cross(p[1] - p[0], p[2] - p[0]), ng) < 0;
  return {std::move(p), {{0, 1, 2}}, {}, {}, is_flipped};
}

// One patch of the mesh, facing as it does there.
BilinearMesh patch(const BilinearMesh& mesh, size_t i) {
  std::vector<Vec3> p;
  for (const int v : mesh.patches()[i])
    p.push_back(mesh.positions()[static_cast<size_t>(v)]);
  const Vec3 ng = mesh.point(static_cast<uint32_t>(i), {0.5f, 0.5f}).ng;
  const Vec3 normal = cross(p[1] + p[3] - p[0] - p[2], p[2] + p[3] - p[0] - p[1]);
  return {std::move(p), {{0, 1, 2, 3}}, {}, {}, dot(normal, ng) < 0};
}

template <typename Mesh, typename Piece>
std::vector<EmissivePart> pieces_of(const Mesh& mesh, size_t count,
                                    const AreaLightRequest& light, Piece&& piece) {
  std::vector<float> areas;
  for (size_t i = 0; i < count; ++i) areas.push_back(piece(mesh, i).area());
  if (are_equal(areas)) return {{mesh, emission_of(light, areas[0])}};
  std::vector<EmissivePart> parts;
  for (size_t i = 0; i < count; ++i)
    parts.push_back({piece(mesh, i), emission_of(light, areas[i])});
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
  if (const auto* mesh = std::get_if<TriangleMesh>(&shape))
    return pieces_of(*mesh, mesh->triangles().size(), *light, triangle);
  if (const auto* mesh = std::get_if<BilinearMesh>(&shape))
    return pieces_of(*mesh, mesh->patches().size(), *light, patch);
  const AreaEmission emission = emission_of(*light, area(shape));
  whole.push_back({std::move(shape), emission});
  return whole;
}

}  // namespace tyndall::loader
