// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tyndall {

class LightVisibility;
class RecordCache;

/// Which connections the vertices of a walk make, beside next event estimation.
struct ConnectionSettings {
  bool single = false;  ///< through one further scattering vertex on the leg
  bool dual = false;    ///< through two: one on the leg, one beyond
  /// Legs along which the distance to the light varies by less than this factor leave
  /// single connections to next event estimation: there is nothing to gain. Dual ones have
  /// a direction to gain.
  float min_distance_ratio = 1.2f;
  bool visibility = false;  ///< predict what the lights see, for distances
  /// ... what lights at infinity see, too, with forced collisions on every leg.
  bool far_visibility = true;
  bool sky_directions = true;  ///< ... and where skies are seen, for directions to them
  /// What they see, instead of tracing it.
  std::shared_ptr<const LightVisibility> known_visibility = {};
  /// Connect to surfaces that lights shine on, by way of as many surfaces in all; zero: do
  /// not.
  int lit_surfaces = 0;
  /// Trace light over specular surfaces into the camera where a scene gives reason to.
  bool particles = true;
  bool roulette = false;    ///< learn how likely walks are to go on
  bool direction = false;   ///< learn the directions of dual connections
  bool product = true;      ///< ... and multiply them by the phase function
  bool pretraining = true;  ///< ... beginning with what arrives if nothing is in the way
  size_t direction_memory = 128'000'000;  ///< at most, samples included [bytes]
  /// What is known of directions beforehand, for the light clusters of the scene; a render
  /// that is given this learns no more.
  std::shared_ptr<const RecordCache> known_directions = {};
};

/// The settings of an integrator of that name with options as `--set` gives them, by dotted
/// name. Throws std::invalid_argument for an unknown integrator, option or value; the
/// message names the nearest valid one, the integrators that have an option, or all options
/// there are.
ConnectionSettings connection_settings(const std::string& integrator,
                                       const std::map<std::string, std::string>& options);

/// The names of all integrators, in the order of what they can do.
std::vector<std::string> integrator_names();

}  // namespace tyndall
