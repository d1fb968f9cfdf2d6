// SPDX-License-Identifier: Apache-2.0
#include "apps/tyndall/inspect/direction_maps.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "apps/tyndall/inspect/brute_force.h"
#include "apps/tyndall/inspect/known_guiding.h"
#include "apps/tyndall/inspect/raster_plot.h"
#include "tyndall/image/false_color.h"
#include "tyndall/integrators/dual_direction.h"

namespace tyndall::app {
namespace {

constexpr int rays_per_direction = 32;
constexpr int gap = 8;               // between the maps [pixels]
constexpr float color_range = 1e4f;  // of the brightest color over the darkest

// What arrives at a vertex from one direction, by way of one scattering and one light: an
// estimate from few samples.
class ScatteredLight {
 public:
  ScatteredLight(const Scene& scene, const ConnectionContext& context, size_t light)
      : scene_(&scene), context_(&context), light_(light) {}

  float estimate(const Vertex& from, const Medium* medium, Vec3 w, uint64_t key) const {
    RandomStream random(key);
    const Pivots pivots(*scene_, random.next_bits());
    Leg leg(*scene_, from.spawn(w), medium);
    ConnectionLeg connections(*context_, pivots, leg);
    const ConnectionLeg::Single* technique = connections.single(light_);
    float sum = 0;
    for (int i = 0; technique && i < rays_per_direction; ++i) {
      const float u = (static_cast<float>(i) + random.next_1d()) / rays_per_direction;
      if (const auto s = technique->sample(u))
        sum += at(connections, medium, s->t, random) / s->pdf_t;
    }
    return sum / rays_per_direction;
  }

 private:
  float at(const ConnectionLeg& leg, const Medium* start, float t,
           RandomStream& random) const {
    const Medium* medium = leg.proxy().medium_at(t);
    if (!medium) return 0;
    const Vertex vertex(leg.ray().at(t), -leg.ray().d, medium);
    const Rgb scattered =
        scattered_light(*scene_, vertex, *medium, scene_->lights()[light_], random);
    const Rgb T = transmittance(*scene_, leg.ray(), t, start, random);
    return luminance(medium->at(vertex.p()).sigma_s * T * scattered);
  }

  const Scene* scene_;
  const ConnectionContext* context_;
  size_t light_;
};

// Sums over the square for the relative variance of a density.
struct SecondMoment {
  double squares = 0;

  // `squared` is the square of the truth.
  void add(float squared, float density) {
    if (density > 0) squares += double{squared} / double{density};
  }
  float relative_variance(double mean, double cells) const {
    return mean > 0 ? static_cast<float>(squares / cells / (mean * mean) - 1) : -1;
  }
};

void draw_map(Image& picture, int x0, const std::vector<float>& map, float high) {
  for (int y = 0; y < DirectionMaps::side; ++y)
    for (int x = 0; x < DirectionMaps::side; ++x) {
      const float value = map[static_cast<size_t>(y * DirectionMaps::side + x)];
      const float share = 1 + std::log(value / high) / std::log(color_range);
      picture.set_rgb(x0 + x, y, share > 0 ? false_color(std::min(share, 1.0f)) : Rgb(0));
    }
}

}  // namespace

DirectionMaps direction_maps(const Scene& scene, const GuidingFile& file, const Ray& ray,
                             float t, std::optional<size_t> light) {
  const ConnectionContext learned(scene, known_guiding(&file)),
      plain(scene, known_guiding(nullptr));
  const Pivots pivots(scene, 1);
  Leg leg(scene, ray, scene.camera_medium());
  ConnectionLeg first(learned, pivots, leg);
  const Medium* medium = first.is_empty() ? nullptr : first.proxy().medium_at(t);
  if (!medium) throw std::invalid_argument("nothing scatters at this distance");
  DirectionMaps maps{
      .light = shown_light(first, scene, light), .truth = {}, .learned = {}, .joint = {}};
  const Vec3 b = ray.at(t), pivot = *first.pivot(maps.light);
  const Vertex vertex(b, -ray.d, medium);
  const auto technique = [&](const ConnectionContext& context) {
    return dual_direction(context, *medium, b, ray.d, maps.light, pivot);
  };
  const DualDirection with_records = technique(learned), without = technique(plain);
  const LightSquare square(Frame::from_z(normalize(pivot - b)),
                           SquareMeasure::joint_sampling);
  const ScatteredLight scattered(scene, learned, maps.light);
  SecondMoment of_learned, of_joint;
  double mean = 0;
  constexpr int cells = DirectionMaps::side * DirectionMaps::side;
  for (int i = 0; i < cells; ++i) {
    const Vec2 p{
        (static_cast<float>(i % DirectionMaps::side) + 0.5f) / DirectionMaps::side,
        (static_cast<float>(i / DirectionMaps::side) + 0.5f) / DirectionMaps::side};
    const SquareDirection d = square.direction(p);
    const float phase = luminance(vertex.eval(d.w)) / d.density;
    const auto key = static_cast<uint64_t>(i);
    // Two estimates, whose product has the mean of a square.
    const float one = phase * scattered.estimate(vertex, medium, d.w, hash(key, 1));
    const float two = phase * scattered.estimate(vertex, medium, d.w, hash(key, 2));
    maps.truth.push_back(0.5f * (one + two));
    maps.learned.push_back(with_records.pdf(d.w) / d.density);
    maps.joint.push_back(without.pdf(d.w) / d.density);
    mean += 0.5 * (double{one} + double{two}) / cells;
    of_learned.add(one * two, maps.learned.back());
    of_joint.add(one * two, maps.joint.back());
  }
  for (float& value : maps.truth) value = mean > 0 ? value / static_cast<float>(mean) : 0;
  maps.learned_variance = of_learned.relative_variance(mean, cells);
  maps.joint_variance = of_joint.relative_variance(mean, cells);
  return maps;
}

Image draw_direction_maps(const DirectionMaps& maps, const std::string& title) {
  constexpr int scale = 2, side = DirectionMaps::side;
  std::vector<float> sorted = maps.truth;
  std::ranges::sort(sorted);
  const float high = std::max(2 * sorted[sorted.size() - sorted.size() / 500 - 1], 1.0f);
  Image small(3 * side + 2 * gap, side);
  draw_map(small, 0, maps.truth, high);
  draw_map(small, side + gap, maps.learned, high);
  draw_map(small, 2 * (side + gap), maps.joint, high);
  Image picture(small.width() * scale, small.height() * scale);
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 0; x < picture.width(); ++x)
      picture.set_rgb(x, y, small.rgb(x / scale, y / scale));
  return frame_picture(picture, title,
                       {.low = high / color_range,
                        .high = high,
                        .label = "brute force, learned, joint sampling: density on the "
                                 "square about the light"});
}

}  // namespace tyndall::app
