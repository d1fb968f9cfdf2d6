// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tyndall/image/film.h"
#include "tyndall/integrators/connection_settings.h"
#include "tyndall/integrators/render_settings.h"
#include "tyndall/scene/scene.h"

namespace tyndall {

/// How far a render has come.
struct RenderProgress {
  double fraction;           ///< of the work, by samples or by time, whichever ends first
  double seconds;            ///< since the start
  double seconds_remaining;  ///< estimated; zero: nothing or unknown
  uint32_t samples;          ///< finished per pixel
  std::string phase;         ///< "training", "rendering"
};

/// How a render is run, as opposed to what is rendered.
struct RenderOptions {
  int threads = 0;  ///< zero: all that the process may use
  /// [s], of preparation and passes. It ends a pass in hand, of which only what is finished
  /// is kept: pixels differ by a pass in their numbers of samples, and are each divided by
  /// their own. If it is too short for a sample of each pixel, those of the first pass are
  /// spread over the picture, see Film::develop().
  std::optional<double> time_limit;
  /// Set to true from anywhere, a signal handler too, to stop as a time limit does.
  const std::atomic<bool>* stop = nullptr;
  /// Called from one thread at a time, at most about ten times a second, and at the end.
  std::function<void(const RenderProgress&)> on_progress;
  /// Hand back what the integrator has learned, in the format of GuidingFileWriter.
  /// render() throws std::invalid_argument if it learns nothing in any scene.
  bool dump_guiding = false;
  /// Called after each pass that was finished, with the film so far and its samples per
  /// pixel, for checkpoints.
  std::function<void(const Film&, uint32_t samples)> on_pass;
};

struct RenderStatistics {
  double seconds = 0;  ///< wall time in the passes, training included
  double training_seconds = 0;
  double cpu_seconds = 0;          ///< of the process during the render
  uint32_t samples_per_pixel = 0;  ///< that each pixel has at least
  int64_t unsampled_pixels = 0;
  int64_t paths = 0;
  int threads = 0;
  bool stopped_early = false;  ///< by time limit or `stop`
  RejectedSamples rejected;
  /// What the integrator has to say, by dotted name: "path.length.mean", "guiding.records".
  std::map<std::string, double> counters;
  std::vector<std::string> notes;  ///< sentences for the user
};

struct RenderResult {
  Film film;
  RenderStatistics statistics;
  std::vector<std::byte> guiding = {};  ///< if RenderOptions::dump_guiding asks for it
};

/// Renders in passes of growing size. The same scene, seed and number of samples give the
/// same film bit for bit with any number of threads. Throws std::invalid_argument for an
/// unknown integrator or option, naming the nearest valid ones.
RenderResult render(const Scene& scene, const RenderSettings& settings,
                    const RenderOptions& options = {});

}  // namespace tyndall
