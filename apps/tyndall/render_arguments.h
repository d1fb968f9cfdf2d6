// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/tyndall/arguments.h"
#include "apps/tyndall/parse_values.h"
#include "tyndall/image/io.h"
#include "tyndall/integrators/render_settings.h"

namespace tyndall::app {

/// What `tyndall render` is asked to do. What is empty stays as the scene file says.
struct RenderArguments {
  std::string scene;
  std::vector<std::string> outputs;
  std::optional<std::string> guiding;  ///< where to write what was learned

  std::optional<uint32_t> samples_per_pixel;
  std::optional<double> time_limit;  ///< [s]
  std::optional<std::string> integrator;
  std::optional<int> max_depth;
  std::optional<ScatteringOrders> orders;
  std::optional<std::string> sampler;
  std::optional<uint64_t> seed;
  std::vector<std::pair<std::string, std::string>> assignments;  ///< option name, value

  std::optional<Vec2i> size;
  std::optional<CropWindow> crop;
  std::optional<Vec2i> pixel;

  bool half = false;
  bool full_float = false;
  float exposure = 0;  ///< [stops]
  std::string tone = "plain";

  int threads = 0;
  bool strict = false;
  bool dry_run = false;
  bool quiet = false;
  bool verbose = false;
  std::string progress = "auto";
  std::string stats;
};

/// Declares the arguments; values land in `arguments`, which must outlive the parsing.
void declare_render_arguments(Command& command, RenderArguments& arguments);

/// Lays what was asked for over the settings of a scene file. Throws UsageError for a crop
/// window or pixel outside the picture, std::invalid_argument for a bad assignment.
void apply(const RenderArguments& arguments, RenderSettings& settings);

/// How images are to be written. Throws UsageError for --half together with --float.
WriteOptions write_options(const RenderArguments& arguments);

}  // namespace tyndall::app
