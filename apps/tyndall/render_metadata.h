// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tyndall/image/image.h"
#include "tyndall/integrators/render.h"

namespace tyndall::app {

/// Adds what a picture should say of itself, as EXR attributes: software, commandLine,
/// scene, integrator, sampler, seed (text); renderTimeSeconds, samplesPerPixel,
/// rejectedSamples (numbers); worldToCamera, worldToNDC (matrices for column vectors, row
/// by row, as pbrt-v4 writes them).
void add_metadata(Image& image, const Scene& scene, const RenderSettings& settings,
                  const RenderStatistics& statistics, const std::string& scene_path,
                  const std::string& command_line);

}  // namespace tyndall::app
