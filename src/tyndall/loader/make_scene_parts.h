// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tyndall/geometry/shape.h"
#include "tyndall/integrators/render_settings.h"
#include "tyndall/lights/light.h"
#include "tyndall/loader/files.h"
#include "tyndall/loader/graphics_state.h"
#include "tyndall/loader/parameter_set.h"
#include "tyndall/loader/textures.h"
#include "tyndall/materials/bsdf.h"
#include "tyndall/media/medium.h"
#include "tyndall/scene/camera.h"

namespace tyndall::loader {

// Each turns the parameters of a directive into a value. All report what is wrong at the
// parameter; they throw Failure where no sensible value is left, for an unknown type too.

/// A camera whose screen window may still depend on the film.
struct CameraRequest {
  PerspectiveCamera::Settings settings;
  std::optional<float> aspect_ratio;
  bool has_screen_window = false;
  float exposure_time = 1;  ///< from the shutter's opening to its closing
};
CameraRequest make_camera(const std::string& type, ParameterSet& parameters,
                          const Transform& camera_from_world);
/// Fills in the screen window as pbrt-v4 does: the shorter side spans [-1, 1].
PerspectiveCamera::Settings fit_to_film(const CameraRequest& camera, Vec2i resolution);

/// The exposure time is not known yet: `imaging_ratio` is that of one.
void set_film(const std::string& type, ParameterSet& parameters, RenderSettings& settings);
void set_pixel_filter(const std::string& type, ParameterSet& parameters,
                      RenderSettings& settings);
void set_sampler(const std::string& type, ParameterSet& parameters,
                 RenderSettings& settings);
void set_integrator(const std::string& type, ParameterSet& parameters,
                    RenderSettings& settings);

/// Empty, with a report, if tyndall does not have that kind of medium yet.
std::optional<Medium> make_medium(ParameterSet& parameters,
                                  const Transform& world_from_medium,
                                  const FileFinder& files);

/// `named` are the materials that "mix" may refer to.
Material make_material(const std::string& type, ParameterSet& parameters,
                       const TextureTable& textures,
                       const std::map<std::string, Material, std::less<>>& named);

/// Empty, with a report, if tyndall does not have that kind of light yet.
std::optional<Light> make_light(const std::string& type, ParameterSet& parameters,
                                const Transform& world_from_light, const FileFinder& files);
std::optional<AreaLightRequest> make_area_light(const std::string& type,
                                                ParameterSet& parameters,
                                                const FileFinder& files);

/// Empty, with a report, if tyndall does not have that kind of shape yet.
std::optional<Shape> make_shape(const std::string& type, ParameterSet& parameters,
                                const Transform& world_from_object,
                                bool reverse_orientation, const FileFinder& files);

}  // namespace tyndall::loader
