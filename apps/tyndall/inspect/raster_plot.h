// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tyndall/image/image.h"

namespace tyndall::app {

/// A curve of a plot: its points in the order of x.
struct Curve {
  std::string label;
  Rgb color;  ///< linear
  std::vector<float> x, y;
  bool is_filled = false;  ///< down to zero, in a lighter shade
};

/// Curves over a common axis as an image of 960x540, with ticks, labels and a legend. The
/// y axis begins at zero and ends above most of each curve: a spike may leave it.
Image draw_plot(const std::string& title, const std::string& x_label,
                const std::string& y_label, const std::vector<Curve>& curves);

/// A picture with a frame, a title, and a bar that says which color means what.
struct ColorBar {
  float low, high;  ///< values of the first and the last color, logarithmic
  std::string label;
};
Image frame_picture(const Image& picture, const std::string& title, const ColorBar& bar);

}  // namespace tyndall::app
