// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <optional>

#include "apps/tyndall/report/results.h"
#include "tyndall/integrators/render.h"

namespace tyndall::app {

/// How a run is measured.
struct RunOptions {
  double time_limit = 30;  ///< [s] of rendering; ends after the pass nearest to it
  int threads = 0;
  MetricOptions metrics;
  const std::atomic<bool>* stop = nullptr;
};

/// A measured run and its image.
struct MeasuredRun {
  Run run;
  RenderStatistics statistics;
  Image image;
};

/// Renders until the time is over, to half a pass, with checkpoints at growing intervals;
/// the clock stands still while they are measured. Empty if `stop` became true.
std::optional<MeasuredRun> measure_run(const Scene& scene, const RenderSettings& settings,
                                       const Image& reference, const RunOptions& options);

}  // namespace tyndall::app
