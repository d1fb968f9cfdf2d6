// SPDX-License-Identifier: Apache-2.0
#include "tyndall/geometry/bilinear_mesh.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "tyndall/sampling/random.h"

namespace tyndall {
namespace {

template <typename T, typename Scalar>
T bilinear(const T& a00, const T& a10, const T& a01, const T& a11, Scalar u, Scalar v) {
  return (a00 * (1 - u) + a10 * u) * (1 - v) + (a01 * (1 - u) + a11 * u) * v;
}

// Uniform by area on a patch, by rejection: the length of the normal is convex in (u, v),
// so no larger than at the corners. The further numbers that a rejection needs are a hash
// of `u`; the first try is `u` itself, which keeps the strata of a sampler on a patch that
// is nearly flat.
Vec2 sample_uniform(const BilinearPatch& patch, Vec2 u) {
  if (patch.is_parallelogram()) return u;
  double largest = 0;
  for (const double x : {0.0, 1.0})
    for (const double y : {0.0, 1.0})
      largest = std::max(largest, length(patch.normal(x, y)));
  RandomStream random(hash(std::bit_cast<uint32_t>(u.x), std::bit_cast<uint32_t>(u.y)));
  constexpr int tries = 1000;  // one in two or three succeeds
  for (int i = 0; i < tries; ++i) {
    const double size =
        length(patch.normal(static_cast<double>(u.x), static_cast<double>(u.y)));
    if (static_cast<double>(random.next_1d()) * largest < size) break;
    u = random.next_2d();
  }
  return u;
}

}  // namespace

Vec3d BilinearPatch::position(double u, double v) const {
  return bilinear(p00, p10, p01, p11, u, v);
}

Vec3d BilinearPatch::normal(double u, double v) const {
  const Vec3d by_u = (p10 - p00) * (1 - v) + (p11 - p01) * v;
  const Vec3d by_v = (p01 - p00) * (1 - u) + (p11 - p10) * u;
  return cross(by_u, by_v);
}

bool BilinearPatch::is_parallelogram() const {
  const Vec3d twist = p00 - p10 - p01 + p11;
  return dot(twist, twist) <=
         1e-12 * std::max(dot(p11 - p00, p11 - p00), dot(p10 - p01, p10 - p01));
}

double BilinearPatch::area() const {
  if (is_parallelogram()) return length(normal(0.5, 0.5));
  // Gauss-Legendre with three nodes on each of a few cells: exact unless the normal turns
  // sharply.
  constexpr int cells = 8;
  constexpr double offset = 0.38729833462074168852;  // sqrt(3/5) / 2
  constexpr double nodes[3] = {0.5 - offset, 0.5, 0.5 + offset};
  constexpr double weights[3] = {5.0 / 18, 8.0 / 18, 5.0 / 18};
  double sum = 0;
  for (int i = 0; i < 3 * cells; ++i)
    for (int j = 0; j < 3 * cells; ++j) {
      const double u = (i / 3 + nodes[i % 3]) / cells, v = (j / 3 + nodes[j % 3]) / cells;
      sum += weights[i % 3] * weights[j % 3] * length(normal(u, v));
    }
  return sum / (cells * cells);
}

BilinearMesh::BilinearMesh(std::vector<Vec3> positions,
                           std::vector<std::array<int, 4>> patches,
                           std::vector<Vec3> normals, std::vector<Vec2> uvs,
                           bool flip_normals)
    : positions_(std::move(positions)),
      patches_(std::move(patches)),
      normals_(std::move(normals)),
      uvs_(std::move(uvs)),
      flip_normals_(flip_normals) {
  areas_.reserve(patches_.size());
  for (uint32_t i = 0; i < patches_.size(); ++i) areas_.append(patch(i).area());
}

BilinearPatch BilinearMesh::patch(uint32_t primitive) const {
  const auto corner = [&](size_t i) {
    return Vec3d(positions_[static_cast<size_t>(patches_[primitive][i])]);
  };
  return {.p00 = corner(0), .p10 = corner(1), .p01 = corner(2), .p11 = corner(3)};
}

SurfacePoint BilinearMesh::point(uint32_t primitive, Vec2 uv) const {
  const BilinearPatch corners = patch(primitive);
  const auto u = static_cast<double>(uv.x), v = static_cast<double>(uv.y);
  const auto interpolate = [&](const auto& values) {
    const auto at = [&](size_t i) {
      return values[static_cast<size_t>(patches_[primitive][i])];
    };
    return bilinear(at(0), at(1), at(2), at(3), uv.x, uv.y);
  };
  Vec3 ng = to_float(normalize_or_z(corners.normal(u, v)));
  Vec3 ns = flip_normals_ ? -ng : ng;
  if (!normals_.empty()) {
    const Vec3 n = interpolate(normals_);
    if (length_squared(n) > 0) ns = normalize(n);
  }
  if (dot(ng, ns) < 0) ng = -ng;
  return {.p = to_float(corners.position(u, v)),
          .ng = ng,
          .ns = ns,
          .uv = uvs_.empty() ? uv : interpolate(uvs_)};
}

Bounds3 BilinearMesh::bounds() const {
  Bounds3 b;
  for (const std::array<int, 4>& corners : patches_)
    for (const int i : corners) {
      const Vec3 p = positions_[static_cast<size_t>(i)];
      if (is_finite(p)) b.extend(p);
    }
  return b;
}

ShapeSample BilinearMesh::sample(Vec2 u) const {
  if (!(areas_.total() > 0)) return {.point = {}, .pdf_area = 0};
  const PrimitiveChoice choice = areas_.choose(u.x);
  const Vec2 uv = sample_uniform(patch(choice.primitive), {choice.u_remapped, u.y});
  const SurfacePoint on = point(choice.primitive, uv);
  return {.point = on, .pdf_area = pdf_area(on)};
}

float BilinearMesh::pdf_area(const SurfacePoint&) const {
  return areas_.total() > 0 ? static_cast<float>(1 / areas_.total()) : 0;
}

}  // namespace tyndall
