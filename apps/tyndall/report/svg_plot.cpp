// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "apps/tyndall/report/error_curve.h"
#include "apps/tyndall/report/html_text.h"

namespace tyndall::app {

namespace {

constexpr double width = 600, height = 380;
constexpr double left = 64, right = 16, top = 14, bottom = 46;

/// A logarithmic axis from `low` to `high`, drawn from pixel `begin` to `end`.
struct LogAxis {
  double low, high, begin, end;

  double at(double x) const {
    const double t =
        (std::log10(x) - std::log10(low)) / (std::log10(high) - std::log10(low));
    return begin + t * (end - begin);
  }
  /// 1, 2 and 5 times powers of ten, or powers alone where there are many.
  std::vector<double> ticks() const {
    const bool all = std::log10(high / low) < 2.5;
    std::vector<double> result;
    for (int e = -12; e <= 12; ++e) {
      for (const double m : {1.0, 2.0, 5.0}) {
        const double x = m * std::pow(10, e);
        if (x >= low * 0.999 && x <= high * 1.001 && (all || m == 1)) result.push_back(x);
      }
    }
    return result;
  }
};

struct Plot {
  LogAxis x, y;

  std::string point(double px, double py) const {
    return fmt::format("{:.1f},{:.1f}", x.at(px), y.at(py));
  }
};

Plot make_plot(const std::vector<ErrorCurve>& curves) {
  double x0 = 1e300, x1 = 0, y0 = 1e300, y1 = 0;
  for (const ErrorCurve& curve : curves) {
    for (const ErrorCurve::Point& p : curve.points) {
      x0 = std::min(x0, p.x), x1 = std::max(x1, p.x);
      y0 = std::min(y0, p.low), y1 = std::max(y1, p.high);
    }
  }
  return {{x0, x1 * 1.02, left, width - right}, {y0 / 1.3, y1 * 1.3, height - bottom, top}};
}

std::string grid(const Plot& plot) {
  std::string svg = "<g class=\"grid\">";
  for (const double x : plot.x.ticks()) {
    svg += fmt::format(
        "<path d=\"M{0:.1f} {1}V{2}\"/><text x=\"{0:.1f}\" y=\"{3}\" "
        "text-anchor=\"middle\">{4:g}</text>",
        plot.x.at(x), top, height - bottom, height - bottom + 16, x);
  }
  for (const double y : plot.y.ticks()) {
    svg += fmt::format(
        "<path d=\"M{1} {0:.1f}H{2}\"/><text x=\"{3}\" y=\"{4:.1f}\" "
        "text-anchor=\"end\">{5:g}</text>",
        plot.y.at(y), left, width - right, left - 6, plot.y.at(y) + 4, y);
  }
  return svg + "</g>";
}

std::string curve_svg(const Plot& plot, const ErrorCurve& curve, const std::string& color) {
  std::string band, line;
  for (const ErrorCurve::Point& p : curve.points) {
    band += plot.point(p.x, p.high) + " ";
    line += plot.point(p.x, p.mean) + " ";
  }
  for (auto p = curve.points.rbegin(); p != curve.points.rend(); ++p) {
    band += plot.point(p->x, p->low) + " ";
  }
  std::string svg = fmt::format(
      "<polygon points=\"{}\" fill=\"{}\" fill-opacity=\".18\"/>"
      "<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\"/>",
      band, color, line, color);
  if (curve.training > plot.x.low && curve.training < plot.x.high) {
    svg += fmt::format(
        "<path d=\"M{:.1f} {}v-12\" stroke=\"{}\" stroke-width=\"3\"><title>{}: learning "
        "ends "
        "at {:.3g} s</title></path>",
        plot.x.at(curve.training), height - bottom, color, escape_html(curve.name),
        curve.training);
  }
  return svg;
}

std::string legend(const std::vector<ErrorCurve>& curves) {
  std::string svg;
  for (size_t i = 0; i < curves.size(); ++i) {
    const double y = top + 16 + 18 * static_cast<double>(i);
    svg += fmt::format(
        "<path d=\"M{0} {1}h22\" stroke=\"{2}\" stroke-width=\"3\"/>"
        "<text x=\"{3}\" y=\"{4}\" text-anchor=\"end\">{5}</text>",
        width - right - 30, y, method_color(i), width - right - 38, y + 4,
        escape_html(curves[i].name));
  }
  return svg;
}

}  // namespace

std::string method_color(size_t i) {
  // Okabe and Ito's palette, which color-blind readers can tell apart.
  constexpr std::array<const char*, 7> colors = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                 "#e69f00", "#56b4e9", "#666666"};
  return colors[i % colors.size()];
}

std::string svg_plot(const std::vector<ErrorCurve>& curves, const std::string& x_label,
                     double marker) {
  const bool empty = std::all_of(curves.begin(), curves.end(),
                                 [](const ErrorCurve& c) { return c.points.empty(); });
  if (empty) return "<p>Too few checkpoints for a plot.</p>";
  const Plot plot = make_plot(curves);
  std::string svg = fmt::format(
      "<svg class=\"plot\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"relMSE over "
      "{}\">",
      width, height, escape_html(x_label));
  svg += grid(plot);
  for (size_t i = 0; i < curves.size(); ++i) {
    svg += fmt::format("<g data-method=\"{}\">{}</g>", i,
                       curve_svg(plot, curves[i], method_color(i)));
  }
  if (marker > plot.x.low && marker < plot.x.high) {
    svg += fmt::format("<path class=\"marker\" d=\"M{:.1f} {}V{}\"/>", plot.x.at(marker),
                       top, height - bottom);
  }
  svg += legend(curves);
  svg += fmt::format(
      "<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>"
      "<text x=\"14\" y=\"{}\" text-anchor=\"middle\" transform=\"rotate(-90 14 "
      "{})\">relMSE"
      "</text></svg>",
      (left + width - right) / 2, height - 8, escape_html(x_label),
      (top + height - bottom) / 2, (top + height - bottom) / 2);
  return svg;
}

std::string svg_file(const std::string& element) {
  constexpr const char* style =
      "<style>text{font:12px sans-serif;fill:#1c2024}.grid path{stroke:#d5dade}"
      ".marker{stroke:#1c2024;stroke-dasharray:5 4;opacity:.6}</style>"
      "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>";
  const size_t name = std::string("<svg").size(), inside = element.find('>') + 1;
  return "<svg xmlns=\"http://www.w3.org/2000/svg\"" + element.substr(name, inside - name) +
         style + element.substr(inside) + "\n";
}

}  // namespace tyndall::app
