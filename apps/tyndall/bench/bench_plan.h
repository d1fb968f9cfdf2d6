// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/tyndall/render_arguments.h"
#include "apps/tyndall/report/results.h"

namespace tyndall::app {

/// What `tyndall bench` is asked to do.
struct BenchPlan {
  std::vector<std::string> scenes;  ///< files
  std::vector<Method> methods;      ///< without runs
  int seeds = 5;                    ///< 0, 1, ...
  double time_limit = 30;           ///< [s] of each run
  std::string folder = "results";   ///< of results.json and the images
  std::optional<std::string> reference;
  bool make_reference = false;
  std::optional<double> reference_time;  ///< [s]; ten times time_limit if empty
  double epsilon = 0.01;
  bool no_flip = false;
  bool quiet = false;
  RenderArguments render;  ///< size, depth, options and threads of every run
};

/// "volpath,learned:learned.direction=off": integrators, each with options of its own after
/// colons; the text of each is the method's name. Throws std::invalid_argument.
std::vector<Method> parse_methods(const std::string& text);

/// A short name for each scene: the file's, or its folder's if that is "scene", or with its
/// folder's before it where that would not be unique. Throws UsageError if that is not
/// unique either.
std::vector<std::string> scene_names(const std::vector<std::string>& paths);

/// Throws UsageError if the plan does not make sense.
void check_plan(const BenchPlan& plan);

/// A hash of a file's bytes, 16 hexadecimal digits (FNV-1a).
std::string file_hash(const std::string& path);

}  // namespace tyndall::app
