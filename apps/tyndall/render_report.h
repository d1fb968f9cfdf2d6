// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tyndall/image/image.h"
#include "tyndall/integrators/render.h"

namespace tyndall::app {

/// Everything that is worth telling of a render that has ended.
struct RenderReport {
  std::string scene;
  std::string command_line;
  std::vector<std::string> outputs;  ///< files written
  RenderSettings settings;
  RenderStatistics statistics;
  double load_seconds = 0;   ///< reading the scene file
  double build_seconds = 0;  ///< acceleration structures, light tables
  int warning_count = 0;
};

/// The most memory that this process has held [bytes].
int64_t peak_memory();

/// A few lines for a person: time, samples, speed, what went wrong.
std::string summary(const RenderReport& report);
/// The integrator's counters, one to a line.
std::string counter_table(const RenderStatistics& statistics);
/// One JSON object, for --stats json; docs/cli.md lists its fields.
std::string to_json(const RenderReport& report, const Image& image);
/// "pixel 3,4: 0.25 0.5 0.125 +- 0.01 0.02 0.01": the only pixel of `image`, with standard
/// errors.
std::string describe_pixel(const Image& image);

}  // namespace tyndall::app
