// SPDX-License-Identifier: Apache-2.0
#include "tyndall/integrators/lit_surface.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "tyndall/integrators/leg.h"
#include "tyndall/integrators/pilot_points.h"
#include "tyndall/math/frame.h"
#include "tyndall/sampling/warps.h"

namespace tyndall {
namespace {

constexpr size_t max_bytes = size_t{16} << 20, max_bytes_of_places = size_t{32} << 20;
// With more, not even the coarsest squares of all places are worth their memory.
constexpr size_t max_squares_of_places = 256;

// What matters of the scene: where media scatter light that gets to the camera.
Bounds3 bounds_of_interest(const Scene& scene) {
  Bounds3 box;
  for (const Vec3 p : pilot_points(scene)) box.extend(p);
  return box.is_empty() || !(box.radius() > 0) ? scene.bounds() : box;
}

using Squares = std::vector<std::optional<EmissionSquare>>;

Squares squares_of(const Scene& scene) {
  const Bounds3 box = bounds_of_interest(scene);
  Squares squares;
  for (const Light& light : scene.lights())
    squares.push_back(EmissionSquare::of(light, box, scene.bounds()));
  return squares;
}

// Before anything is learned, a walk over one more surface is tried half as often.
std::vector<float> powers(const Scene& scene, const Squares& squares, int max_surfaces) {
  std::vector<float> powers;
  for (const std::optional<EmissionSquare>& square : squares) {
    float power = square ? square->power(scene.bounds()) : 0;
    for (int i = 0; i < max_surfaces; ++i, power *= 0.5f) powers.push_back(power);
  }
  return powers;
}

const DiffuseBsdf& diffuse(const SurfaceHit& hit) {
  return std::get<DiffuseBsdf>(hit.surface->material);
}

}  // namespace

void LitChain::push_front(float density) {
  is_seen_from_leg = is_seen_from_leg && size < max_lit_surfaces;
  size = std::min(size + 1, max_lit_surfaces);
  for (int i = size - 1; i > 0; --i) edge[i] = edge[i - 1];
  edge[0] = density;
}

void LitChain::push_back(float density) {
  is_seen_from_leg = false;
  if (size < max_lit_surfaces) edge[size++] = density;
}

float diffuse_edge_density(Vec3 ng0, Vec3 ng1, Vec3 w, float distance) {
  return abs_dot(ng0, w) * abs_dot(ng1, w) * inv_pi / sqr(distance);
}

LitSurfaceSampling::LitSurfaceSampling(const Scene& scene, int max_surfaces, size_t places)
    : scene_(&scene),
      max_surfaces_(max_surfaces),
      squares_(squares_of(scene)),
      whole_(powers(scene, squares_, max_surfaces), max_bytes) {
  assert(1 <= max_surfaces && max_surfaces <= max_lit_surfaces && places > 0);
  if (places == 1 || whole_.squares() > max_squares_of_places) return;
  const std::vector<float> weights = powers(scene, squares_, max_surfaces);
  for (size_t i = 0; i < places; ++i)
    places_.emplace_back(weights, max_bytes_of_places / places);
}

void LitSurfaceSampling::update() {
  whole_.update();
  for (LearnedSquares& place : places_) place.update(whole_);
}

size_t LitSurfaceSampling::memory() const {
  size_t bytes = whole_.memory();
  for (const LearnedSquares& place : places_) bytes += place.memory();
  return bytes;
}

bool LitSurfaceSampling::finds(const Surface& surface) {
  const auto* material = std::get_if<DiffuseBsdf>(&surface.material);
  return material && !is_black(material->reflectance);
}

std::optional<LitPoint> LitSurfaceSampling::sample(size_t place, float u_choice,
                                                   Vec2 u_point, Vec2 u_direction,
                                                   RandomStream& rng) const {
  SquaresSample choice = at(place).sample(u_choice, u_direction);
  const size_t light = choice.index / max_surfaces_;
  const int surfaces = static_cast<int>(choice.index % max_surfaces_) + 1;
  const std::optional<EmissionSquare>& square = squares_[light];
  if (!square || !(choice.density > 0)) return std::nullopt;
  if (!square->is_invertible())  // directions are all alike
    choice = {choice.index, u_direction, at(place).probability(choice.index)};
  const EmittedRay emitted = square->emit(choice.p, u_point);
  if (!(emitted.pdf > 0) || is_black(emitted.emission)) return std::nullopt;
  LitPoint lit{.hit = {},
               .flux = emitted.emission / (emitted.pdf * choice.density),
               .surfaces = 0,
               .edge = {},
               .chain = {},
               .first = {},
               .light = light,
               .on_light = emitted.on,
               .choice = choice};
  if (!go(lit, emitted.ray)) return std::nullopt;
  lit.first = lit.hit;
  while (lit.surfaces < surfaces)
    if (!bounce(lit, rng)) return std::nullopt;
  return lit;
}

// To the next surface. False if there is none that is found.
bool LitSurfaceSampling::go(LitPoint& lit, const Ray& ray) const {
  const bool is_from_infinity =
      lit.surfaces == 0 && scene_->lights()[lit.light].is_infinite();
  const std::optional<SurfaceHit> hit = scene_->intersect_opaque(ray, infinity);
  if (!hit || !finds(*hit->surface)) return false;
  lit.hit = *hit;
  lit.edge[lit.surfaces++] = {
      .ray = {offset_origin(hit->point.p, hit->point.ng, -ray.d), -ray.d},
      .length = is_from_infinity ? far_distance : hit->t};
  return true;
}

// Off the last surface, by the cosine to its shading normal.
bool LitSurfaceSampling::bounce(LitPoint& lit, RandomStream& rng) const {
  const SurfaceHit from = lit.hit;
  const Vec3 back = lit.to_previous();
  const Vec3 ns = dot(from.point.ns, back) > 0 ? from.point.ns : -from.point.ns;
  const Vec3 local = sample_cosine_hemisphere(rng.next_2d());
  const Vec3 w = Frame::from_z(ns).to_world(local);
  const float cos_back = dot(from.point.ng, back), cos_w = dot(from.point.ng, w);
  if (!(cos_back * cos_w > 0)) return false;
  // Radiance turns at a shading normal as seen from the camera: its cosine belongs to the
  // direction of the light, see Path::look_at().
  lit.flux *= diffuse(from).reflectance * (dot(ns, back) / local.z) * (cos_w / cos_back);
  if (!go(lit, {offset_origin(from.point.p, from.point.ng, w), w})) return false;
  lit.chain.push_back(diffuse_edge_density(from.point.ng, lit.hit.point.ng, w, lit.hit.t));
  return true;
}

std::array<float, max_lit_surfaces> LitSurfaceSampling::densities(const Places& places,
                                                                  size_t light, Vec3 p,
                                                                  Vec3 to_light,
                                                                  float distance,
                                                                  float cos_light) const {
  std::array<float, max_lit_surfaces> densities{};
  const std::optional<EmissionSquare>& square = squares_[light];
  if (!square) return densities;
  const float base = square->density(p, to_light, distance) * cos_light;
  if (!(base > 0)) return densities;
  const bool is_learned = square->is_invertible();
  const Vec2 u = is_learned ? square->invert(-to_light, p) : Vec2{};
  for (int i = 0; i < max_surfaces_; ++i) {
    const size_t index = light * max_surfaces_ + static_cast<size_t>(i);
    const LearnedSquares& learned = at(places[i]);
    densities[i] =
        base * (is_learned ? learned.density(index, u) : learned.probability(index));
  }
  return densities;
}

}  // namespace tyndall
