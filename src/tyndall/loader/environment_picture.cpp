// SPDX-License-Identifier: Apache-2.0
#include "tyndall/loader/environment_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "tyndall/image/io.h"
#include "tyndall/lights/octahedral.h"
#include "tyndall/loader/reporter.h"
#include "tyndall/math/constants.h"

namespace tyndall::loader {
namespace {

Image read(const std::string& path, Span where) {
  try {
    return read_image(path);
  } catch (const std::runtime_error& error) {
    fail(where, fmt::format("{}", error.what()));
  }
}

// Y or the first channel, where there is no color.
const Channel& grey_channel(const Image& image) {
  const Channel* y = image.find("Y");
  return y ? *y : image.channels().front();
}

}  // namespace

float EnvironmentPicture::illuminance() const {
  double sum = 0;
  for (int y = 0; y < resolution; ++y)
    for (int x = 0; x < resolution; ++x) {
      const Vec2 center{(static_cast<float>(x) + 0.5f) / static_cast<float>(resolution),
                        (static_cast<float>(y) + 0.5f) / static_cast<float>(resolution)};
      const float cos_theta = std::max(octahedral_direction(center).z, 0.0f);
      const size_t i =
          static_cast<size_t>(y) * static_cast<size_t>(resolution) + static_cast<size_t>(x);
      sum += double{luminance(pixels[i])} * double{cos_theta};
    }
  return static_cast<float>(sum * double{4 * pi} / static_cast<double>(pixels.size()));
}

EnvironmentPicture read_environment(const std::string& path, Span where) {
  const Image image = read(path, where);
  if (image.width() != image.height() || image.width() < 1)
    fail(where,
         fmt::format(
             "\"{}\": an environment must be a square equal-area picture, got {} x {} "
             "pixels; "
             "pbrt-v4's \"imgtool makeequiarea\" converts latitude-longitude pictures",
             path, image.width(), image.height()));
  if (image.channels().empty()) fail(where, fmt::format("\"{}\" has no channels", path));
  EnvironmentPicture picture{image.width(), {}};
  picture.pixels.reserve(image.pixel_count());
  const bool has_color = image.has_rgb();
  const std::vector<float>& grey = grey_channel(image).values;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      const Rgb color = has_color ? image.rgb(x, y) : Rgb(grey[picture.pixels.size()]);
      picture.pixels.push_back(is_finite(color) ? clamp_negative(color) : Rgb{});
    }
  return picture;
}

}  // namespace tyndall::loader
