// SPDX-License-Identifier: Apache-2.0
#include "apps/tyndall/inspect/visibility_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/tyndall/inspect/raster_plot.h"
#include "tyndall/image/false_color.h"

namespace tyndall::app {

Image visibility_picture(const VisibilityMap& map, size_t light) {
  const int side = map.rows();
  std::vector<float> finite;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x)
      for (const float d : map.distances(x, y))
        if (d > 0 && d < infinity) finite.push_back(d);
  std::ranges::sort(finite);
  ColorBar bar{.low = 1,
               .high = 10,
               .label =
                   "distance to the first surface [scene units]; "
                   "white: none, black: no light"};
  if (!finite.empty()) {
    bar.low = finite[finite.size() / 100];
    bar.high = std::max(finite[finite.size() - 1 - finite.size() / 100], 1.001f * bar.low);
  }
  // Small maps are drawn larger, pixel by pixel.
  const int scale = std::max(512 / side, 1);
  Image picture(side * scale, side * scale);
  for (int y = 0; y < side * scale; ++y)
    for (int x = 0; x < side * scale; ++x) {
      Rgb sum;
      for (const float d : map.distances(x / scale, y / scale)) {
        const float share = std::log(d / bar.low) / std::log(bar.high / bar.low);
        sum += !(d > 0) ? Rgb(0) : d < infinity ? false_color(0.1f + 0.9f * share) : Rgb(1);
      }
      picture.set_rgb(x, y, sum * 0.25f);
    }
  return frame_picture(
      picture, fmt::format("light {}: what it sees, {}x{} directions", light, side, side),
      bar);
}

}  // namespace tyndall::app
