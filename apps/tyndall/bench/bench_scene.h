// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "apps/tyndall/bench/bench_plan.h"
#include "apps/tyndall/bench/bench_store.h"
#include "tyndall/integrators/render.h"

namespace tyndall::app {

/// A scene that is ready to be measured.
struct BenchScene {
  std::string name, path;
  std::unique_ptr<Scene> scene;
  RenderSettings settings;   ///< of all runs, but for integrator, its options and seed
  SceneResults description;  ///< without methods
  Image reference;
};

/// Loads the scene and finds or renders its reference. Throws UsageError if there is none
/// to be had. Empty if `stop` became true.
std::optional<BenchScene> prepare_scene(const std::string& path, const std::string& name,
                                        const BenchPlan& plan, const BenchStore& store,
                                        const std::atomic<bool>& stop);

/// The settings of one run.
RenderSettings run_settings(const BenchScene& scene, const Method& method, uint64_t seed);

/// The command line that renders the same image: by samples, not by time.
std::string render_command(const BenchScene& scene, const BenchPlan& plan,
                           const Method& method, const Run& run);

/// The mean of variance / (reference^2 + epsilon): what relMSE measures of the reference's
/// own noise. Empty without a variance layer.
std::optional<double> own_rel_mse(const Image& reference, double epsilon);

}  // namespace tyndall::app
