// SPDX-License-Identifier: Apache-2.0
#include "apps/tyndall/render_metadata.h"

#include <fmt/format.h>

#include "apps/tyndall/version.h"

namespace tyndall::app {

namespace {

std::vector<float> flatten(const Transform& transform) {
  std::vector<float> values;
  for (const auto& row : transform.matrix())
    for (const double x : row) values.push_back(static_cast<float>(x));
  return values;
}

}  // namespace

void add_metadata(Image& image, const Scene& scene, const RenderSettings& settings,
                  const RenderStatistics& statistics, const std::string& scene_path,
                  const std::string& command_line) {
  image.text["software"] = version_name();
  image.text["commandLine"] = command_line;
  image.text["scene"] = scene_path;
  image.text["integrator"] = settings.integrator;
  image.text["sampler"] = settings.sampler == SamplerKind::sobol ? "sobol" : "independent";
  image.text["seed"] = std::to_string(settings.seed);
  image.numbers["renderTimeSeconds"] = static_cast<float>(statistics.seconds);
  image.numbers["samplesPerPixel"] = static_cast<float>(statistics.samples_per_pixel);
  image.numbers["rejectedSamples"] = static_cast<float>(statistics.rejected.total());
  const PerspectiveCamera& camera = scene.camera();
  const Transform from_outside = Transform::translate(-scene.description().world_origin);
  image.matrices["worldToCamera"] = flatten(camera.camera_from_world() * from_outside);
  image.matrices["worldToNDC"] = flatten(camera.ndc_from_world() * from_outside);
}

}  // namespace tyndall::app
