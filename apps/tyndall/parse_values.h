// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <string>
#include <utility>

#include "tyndall/integrators/render_settings.h"
#include "tyndall/math/vec.h"

/// Readers of argument texts. All throw std::invalid_argument with a sentence that follows
/// the argument's name: "must be a whole number, got 'x'".
namespace tyndall::app {

/// A number of type int, uint32_t, uint64_t, float or double; the whole text must be one.
template <typename Number>
Number parse_number(const std::string& text);

/// A whole number from `min` to `max`; types as above.
template <typename Number>
Number parse_whole_number(const std::string& text, Number min,
                          Number max = std::numeric_limits<Number>::max());

/// Worker threads: 0, for all there are, to 4096.
int parse_threads(const std::string& text);

/// Scattering vertices of a path, at least 0.
int parse_depth(const std::string& text);

/// "30s", "10m", "1.5h", "1h30m", or a plain number of seconds; must be positive [s].
double parse_duration(const std::string& text);

/// "640x360"; both sides at least 1.
Vec2i parse_size(const std::string& text);

/// A part of the picture.
struct CropWindow {
  float x0 = 0, y0 = 0, x1 = 1, y1 = 1;
  bool is_fraction =
      true;  ///< all values are at most 1: fractions of the picture, not pixels

  /// The pixels [min, max) that the window covers in a picture of `size`; may be empty.
  std::pair<Vec2i, Vec2i> pixels(Vec2i size) const;
};

/// "x0,y0,x1,y1" with x0 < x1 and y0 < y1.
CropWindow parse_crop(const std::string& text);

/// "x,y", both at least 0.
Vec2i parse_pixel(const std::string& text);

/// "1", "2" or a range such as "1-2".
ScatteringOrders parse_orders(const std::string& text);

/// "name=value", name not empty.
std::pair<std::string, std::string> parse_assignment(const std::string& text);

}  // namespace tyndall::app
