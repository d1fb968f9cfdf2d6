// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "apps/tyndall/report/results.h"

/// The parts of the page that need no script. The first method of a scene is its baseline.
namespace tyndall::app {

/// What the scene's runs show, in a sentence for each method after the first.
std::string summary_html(const SceneResults& scene);
/// A check box for each method, which hides it from plots and tables; for scripts to show.
std::string filter_html(const SceneResults& scene);
/// A row for each method: means over the seeds.
std::string method_table_html(const SceneResults& scene);
/// A row for each run, with links to the images, which lie in `folder`.
std::string run_table_html(const SceneResults& scene, const std::string& folder);
/// The integrators' counters and notes.
std::string diagnostics_html(const SceneResults& scene);
/// The commands that render the images again.
std::string commands_html(const SceneResults& scene);

}  // namespace tyndall::app
