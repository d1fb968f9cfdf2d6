// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "apps/tyndall/report/results.h"

namespace tyndall::app {

/// The most bytes that a page may have.
constexpr size_t report_size_limit = 20'000'000;

/// The error plots of a scene: SVG elements, or a sentence where there is too little for
/// one.
struct ScenePlots {
  std::string time, samples;
};
ScenePlots scene_plots(const SceneResults& scene, double time_limit);

struct ReportInput {
  Results results;
  std::string folder;       ///< of the results file: its images lie relative to it
  std::string link_folder;  ///< the same, as the page sees it
};

/// One HTML page that needs nothing else. Pictures are stored in levels of 2.2 %, or
/// coarser where the page would become too large. Throws std::runtime_error if an image
/// cannot be read, or if the page stays too large.
std::string report_page(const std::vector<ReportInput>& inputs);

}  // namespace tyndall::app
