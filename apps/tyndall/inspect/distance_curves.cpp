// SPDX-License-Identifier: Apache-2.0
#include "apps/tyndall/inspect/distance_curves.h"

#include <algorithm>
#include <stdexcept>

#include "apps/tyndall/inspect/brute_force.h"
#include "apps/tyndall/inspect/known_guiding.h"

namespace tyndall::app {
namespace {

constexpr int points = 800, light_samples = 32;

// What arrives at the ray's origin from a point of the ray, by way of one light.
float single_scattering(const Scene& scene, const ConnectionLeg& leg, float t,
                        const Light& light, RandomStream& random) {
  const Medium* medium = leg.proxy().medium_at(t);
  if (!medium) return 0;
  const Vertex vertex(leg.ray().at(t), -leg.ray().d, medium);
  float sum = 0;
  for (int i = 0; i < light_samples; ++i)
    sum += luminance(scattered_light(scene, vertex, *medium, light, random));
  const Rgb T = transmittance(scene, leg.ray(), t, scene.camera_medium(), random);
  return sum / light_samples * luminance(medium->at(vertex.p()).sigma_s * T);
}

float integral(const Curve& curve) {
  float sum = 0;
  for (size_t i = 0; i + 1 < curve.x.size(); ++i)
    sum += 0.5f * (curve.y[i] + curve.y[i + 1]) * (curve.x[i + 1] - curve.x[i]);
  return sum;
}

void normalise(Curve& curve) {
  const float area = integral(curve);
  for (float& y : curve.y) y = area > 0 ? y / area : 0;
}

// Of one sample from `density`, where `truth` is normalised.
float relative_variance(const Curve& truth, const Curve& density) {
  Curve square = truth;
  for (size_t i = 0; i < truth.x.size(); ++i)
    square.y[i] = truth.y[i] > 0 ? truth.y[i] * truth.y[i] / density.y[i] : 0;
  return integral(square) - 1;
}

Curve density_curve(const std::string& label, Rgb color, const std::vector<float>& x,
                    const ConnectionLeg::Single* technique) {
  Curve curve{.label = label, .color = color, .x = x, .y = {}};
  for (const float t : x) curve.y.push_back(technique ? technique->pdf_t(t) : 0);
  return curve;
}

}  // namespace

DistanceCurves distance_curves(const Scene& scene, const GuidingFile& file, const Ray& ray,
                               std::optional<size_t> light) {
  const ConnectionContext learned(scene, known_guiding(&file)),
      plain(scene, known_guiding(nullptr));
  const Pivots pivots(scene, 1);
  Leg leg(scene, ray, scene.camera_medium());
  ConnectionLeg learned_leg(learned, pivots, leg), plain_leg(plain, pivots, leg);
  if (learned_leg.is_empty())
    throw std::invalid_argument("the ray of this pixel meets no medium");
  light = shown_light(learned_leg, scene, light);

  const float t_min = learned_leg.proxy().t_min();
  const float t_max = learned_leg.proxy().distance_to(1e-3f);
  std::vector<float> x;
  for (int i = 0; i <= points; ++i)
    x.push_back(t_min + (static_cast<float>(i) + 0.5f) / (points + 1) * (t_max - t_min));
  DistanceCurves curves{.light = *light};
  curves.truth = {.label = "single scattering, brute force",
                  .color = Rgb(0.25f, 0.45f, 0.9f),
                  .x = x,
                  .y = {},
                  .is_filled = true};
  RandomStream random(7);
  for (const float t : x)
    curves.truth.y.push_back(
        single_scattering(scene, learned_leg, t, scene.lights()[*light], random));
  normalise(curves.truth);
  curves.learned = density_curve("learned density", Rgb(0.8f, 0.05f, 0.03f), x,
                                 learned_leg.single(*light));
  curves.equiangular = density_curve("without visibility", Rgb(0.1f, 0.3f, 0.08f), x,
                                     plain_leg.single(*light));
  curves.learned_variance = relative_variance(curves.truth, curves.learned);
  curves.equiangular_variance = relative_variance(curves.truth, curves.equiangular);
  return curves;
}

}  // namespace tyndall::app
