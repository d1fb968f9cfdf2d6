// SPDX-License-Identifier: Apache-2.0
#include "tyndall/scene/boundary_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

#include "tyndall/geometry/precise.h"

namespace tyndall {
namespace {

// An edge between two welded corners, once per face at it; the direction is the one in
// which the face runs through it, seen from outside.
struct Edge {
  uint32_t low, high;
  int direction;  // +1 from low to high
  const Surface* surface;

  std::pair<uint32_t, uint32_t> ends() const { return {low, high}; }
};

// The faces of all shapes between two media.
class Boundary {
 public:
  void add(const Surface& surface) {
    if (const auto* triangles = std::get_if<TriangleMesh>(&surface.shape))
      add_triangles(*triangles, surface);
    else if (const auto* patches = std::get_if<BilinearMesh>(&surface.shape))
      add_patches(*patches, surface);
    else if (const auto* sphere = std::get_if<Sphere>(&surface.shape);
             sphere && sphere->is_full())
      add_sphere(*sphere, surface);
    else
      pieces_.push_back(&surface);
  }

  struct Gap {
    const Surface* surface;
    std::string what;
  };
  // Empty if the boundary is closed, or may be: whether clipped spheres, disks and meshes
  // with gaps close each other is not looked into.
  std::optional<Gap> gap() {
    const auto [mesh, edges] = mesh_gap();
    if (mesh && pieces_.empty())
      return Gap{mesh, fmt::format("{} edges have a face on one side only", edges)};
    if (!mesh && pieces_.size() == 1)
      return Gap{pieces_[0], "it is a disk or a clipped sphere"};
    return std::nullopt;
  }

  // Negative if the inside is all but what the faces enclose. Only if there is no gap.
  double volume() const { return pieces_.empty() ? volume_ : 0; }
  const Surface* any() const { return any_; }

 private:
  // The first mesh with a gap, and the number of edges of the gaps; null if closed.
  std::pair<const Surface*, size_t> mesh_gap() {
    std::ranges::sort(edges_, {}, &Edge::ends);
    const Surface* first = nullptr;
    size_t count = 0;
    for (size_t i = 0, end = 0; i < edges_.size(); i = end) {
      int sum = 0;
      for (end = i; end < edges_.size() && edges_[end].ends() == edges_[i].ends(); ++end)
        sum += edges_[end].direction;
      if (sum == 0) continue;
      ++count;
      if (!first) first = edges_[i].surface;
    }
    return {first, count};
  }

  void add_sphere(const Sphere& sphere, const Surface& surface) {
    const auto r = static_cast<double>(sphere.radius);
    const double volume = 4 * std::numbers::pi / 3 * r * r * r *
                          std::abs(Affine(sphere.world_from_sphere).determinant());
    volume_ += sphere.flip_normals ? -volume : volume;
    any_ = &surface;
  }

  void add_triangles(const TriangleMesh& mesh, const Surface& surface) {
    for (uint32_t i = 0; i < mesh.triangles().size(); ++i) {
      const PreciseTriangle t = mesh.triangle(i);
      const Vec3 ng = mesh.point(i, {1.0f / 3, 1.0f / 3}).ng;
      const Vec3i& v = mesh.triangles()[i];
      std::array<Vec3, 3> corners;
      for (int k = 0; k < 3; ++k)
        corners[static_cast<size_t>(k)] =
            mesh.positions()[static_cast<size_t>(k == 0   ? v.x
                                                 : k == 1 ? v.y
                                                          : v.z)];
      add_face(corners, dot(t.normal(), Vec3d(ng)) < 0, surface);
    }
  }

  void add_patches(const BilinearMesh& mesh, const Surface& surface) {
    for (uint32_t i = 0; i < mesh.patches().size(); ++i) {
      const std::array<int, 4>& v = mesh.patches()[i];
      std::array<Vec3, 4> corners;
      for (size_t k = 0; k < 4; ++k)  // around the patch
        corners[k] = mesh.positions()[static_cast<size_t>(v[k < 2 ? k : 5 - k])];
      const Vec3d n = mesh.patch(i).normal(0.5, 0.5);
      add_face(corners, dot(n, Vec3d(mesh.point(i, {0.5f, 0.5f}).ng)) < 0, surface);
    }
  }

  template <size_t N>
  void add_face(std::array<Vec3, N> corners, bool is_flipped, const Surface& surface) {
    any_ = &surface;
    if (is_flipped) std::ranges::reverse(corners);
    std::array<uint32_t, N> indices;
    for (size_t i = 0; i < N; ++i) indices[i] = weld(corners[i]);
    for (size_t i = 0; i < N; ++i) {
      const uint32_t a = indices[i], b = indices[(i + 1) % N];
      if (a != b)
        edges_.push_back({std::min(a, b), std::max(a, b), a < b ? 1 : -1, &surface});
    }
    const Vec3d p0(corners[0]);
    for (size_t i = 1; i + 1 < N; ++i)
      volume_ += dot(p0, cross(Vec3d(corners[i]), Vec3d(corners[i + 1]))) / 6;
  }

  uint32_t weld(Vec3 p) {
    // Adding zero makes one of the two zeros.
    const std::tuple key{p.x + 0, p.y + 0, p.z + 0};
    return corners_.emplace(key, static_cast<uint32_t>(corners_.size())).first->second;
  }

  std::map<std::tuple<float, float, float>, uint32_t> corners_;
  std::vector<Edge> edges_;
  std::vector<const Surface*> pieces_;  // disks and clipped spheres
  double volume_ = 0;
  const Surface* any_ = nullptr;
};

}  // namespace

std::vector<std::string> check_boundaries(std::span<const Surface> surfaces) {
  std::map<std::pair<int, int>, Boundary> boundaries;
  for (const Surface& surface : surfaces)
    if (std::holds_alternative<InterfaceBsdf>(surface.material) &&
        surface.media.is_stated && surface.media.is_transition())
      boundaries[{surface.media.inside, surface.media.outside}].add(surface);
  std::vector<std::string> remarks;
  for (auto& [media, boundary] : boundaries) {
    if (const auto gap = boundary.gap())
      remarks.push_back(
          fmt::format("{}: this boundary between media is open ({}): light that passes the "
                      "gap takes the medium along",
                      gap->surface->name, gap->what));
    else if (boundary.volume() < 0 && media.first != no_medium && media.second == no_medium)
      remarks.push_back(
          fmt::format("{}: this boundary is inside out: its medium fills all but what it "
                      "encloses; ReverseOrientation turns it",
                      boundary.any()->name));
  }
  return remarks;
}

}  // namespace tyndall
