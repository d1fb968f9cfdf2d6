// SPDX-License-Identifier: Apache-2.0
#include "apps/tyndall/report/error_curve.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace tyndall::app {

namespace {

/// A checkpoint as logarithms.
struct LogPoint {
  double x, y;
};

using LogLine = std::vector<LogPoint>;

LogLine log_line(const Run& run, CurveAxis axis) {
  LogLine line;
  for (const Checkpoint& c : run.checkpoints) {
    const double x =
        axis == CurveAxis::seconds ? c.seconds : double{1} * c.samples_per_pixel;
    const bool increases = line.empty() || std::log(x) > line.back().x;
    if (x > 0 && c.rel_mse > 0 && std::isfinite(c.rel_mse) && increases) {
      line.push_back({std::log(x), std::log(c.rel_mse)});
    }
  }
  return line;
}

/// Precondition: x lies in the line's range.
double interpolate(const LogLine& line, double x) {
  const auto after = std::find_if(line.begin() + 1, line.end() - 1,
                                  [&](const LogPoint& p) { return p.x >= x; });
  const LogPoint a = *(after - 1), b = *after;
  return a.y + (b.y - a.y) * (x - a.x) / (b.x - a.x);
}

ErrorCurve::Point point_at(const std::vector<LogLine>& lines, double x) {
  double sum = 0, low = 1e300, high = -1e300;
  for (const LogLine& line : lines) {
    const double y = interpolate(line, x);
    sum += y;
    low = std::min(low, y);
    high = std::max(high, y);
  }
  return {std::exp(x), std::exp(sum / static_cast<double>(lines.size())), std::exp(low),
          std::exp(high)};
}

/// A line for each run with two checkpoints or more.
std::vector<LogLine> log_lines(const Method& method, CurveAxis axis) {
  std::vector<LogLine> lines;
  for (const Run& run : method.runs) {
    const LogLine line = log_line(run, axis);
    if (line.size() >= 2) lines.push_back(line);
  }
  return lines;
}

}  // namespace

std::optional<double> error_at(const Method& method, CurveAxis axis, double x) {
  const std::vector<LogLine> lines = log_lines(method, axis);
  const bool inside = std::all_of(lines.begin(), lines.end(), [&](const LogLine& line) {
    return line.front().x <= std::log(x) && std::log(x) <= line.back().x;
  });
  if (lines.size() < method.runs.size() || lines.empty() || !inside) return std::nullopt;
  return point_at(lines, std::log(x)).mean;
}

ErrorCurve error_curve(const Method& method, CurveAxis axis) {
  ErrorCurve curve{method.name, {}, 0};
  const std::vector<LogLine> lines = log_lines(method, axis);
  double training = 0;
  for (const Run& run : method.runs) {
    training += run.training_seconds / static_cast<double>(method.runs.size());
  }
  if (lines.empty()) return curve;
  double begin = lines.front().front().x, end = lines.front().back().x;
  for (const LogLine& line : lines) {
    begin = std::max(begin, line.front().x);
    end = std::min(end, line.back().x);
  }
  constexpr int steps = 40;
  for (int i = 0; i <= steps && begin < end; ++i) {
    curve.points.push_back(point_at(lines, begin + (end - begin) * i / steps));
  }
  if (axis == CurveAxis::seconds) curve.training = training;
  return curve;
}

}  // namespace tyndall::app
