// SPDX-License-Identifier: Apache-2.0
#include "tyndall/integrators/free_flight.h"

#include "tyndall/media/tracking.h"

namespace tyndall {
namespace {

// What did not collide: the same factor for the integrand and the density of each channel.
void pass(Carried& carried, Rgb factor) {
  carried.beta *= factor;
  carried.spectral *= factor;
}

void collide(Carried& carried, const MediumProperties& properties,
             Rgb relative_transmittance, int hero) {
  const Rgb sigma_t = properties.sigma_t();
  carried.beta *= relative_transmittance * properties.sigma_s / sigma_t[hero];
  carried.spectral *= relative_transmittance * sigma_t / sigma_t[hero];
}

}  // namespace

FreeFlight sample_free_flight(const Medium& medium, const Ray& ray, float t_max, int hero,
                              bool is_chromatic, const Carried& carried,
                              RandomStream& rng) {
  FreeFlight flight{.t = std::nullopt, .carried = carried};
  const auto on_collision = [&](float t, const MediumProperties& properties, Rgb majorant,
                                Rgb relative_transmittance) {
    const Rgb sigma_t = properties.sigma_t();
    if (rng.next_1d() * majorant[hero] < sigma_t[hero]) {
      collide(flight.carried, properties, relative_transmittance, hero);
      flight.t = t;
      return false;
    }
    const Rgb sigma_n = clamp_negative(majorant - sigma_t);
    if (!(sigma_n[hero] > 0)) return true;  // rounding; the next collision is as good
    if (is_chromatic)
      pass(flight.carried, relative_transmittance * sigma_n / sigma_n[hero]);
    return true;
  };
  const Rgb to_end = medium.visit([&](const auto& m) {
    return sample_collisions(m, ray, t_max, hero, rng, on_collision);
  });
  if (!flight.t && is_chromatic) pass(flight.carried, to_end);
  return flight;
}

}  // namespace tyndall
