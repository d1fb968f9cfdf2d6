// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/tyndall/report/results.h"

namespace tyndall::app {

/// Error against cost over the seeds of one method.
struct ErrorCurve {
  struct Point {
    double x, mean, low, high;  ///< geometric mean, smallest and largest over the seeds
  };

  std::string name;
  std::vector<Point> points;  ///< increasing in x, where all seeds have checkpoints
  double training = 0;        ///< x where learning ends; zero if there is none
};

enum class CurveAxis { seconds, samples_per_pixel };

/// Interpolates the seeds' checkpoints log-log at common places.
ErrorCurve error_curve(const Method& method, CurveAxis axis);

/// The geometric mean of the seeds' relMSE at `x`; empty where a seed has no checkpoints
/// around it.
std::optional<double> error_at(const Method& method, CurveAxis axis, double x);

/// An SVG element: both axes logarithmic, a line per curve with a band for the spread of
/// its seeds, a vertical dashed line at `marker` if that is above zero.
std::string svg_plot(const std::vector<ErrorCurve>& curves, const std::string& x_label,
                     double marker);

/// An element of svg_plot() as a file of its own, dark on white.
/// Precondition: it is a plot, not the sentence that there is none.
std::string svg_file(const std::string& element);

/// The color of the i-th method, the same in plots and legends: "#0072b2", ...
std::string method_color(size_t i);

}  // namespace tyndall::app
