// SPDX-License-Identifier: Apache-2.0
#include "apps/tyndall/inspect/raster_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/tyndall/inspect/pixel_font.h"
#include "tyndall/image/false_color.h"

namespace tyndall::app {
namespace {

constexpr int plot_width = 960, plot_height = 540;
constexpr int left = 80, right = 20, top = 64, bottom = 52;
const Rgb black(0), light_grey(0.8f), dark_grey(0.2f);

Image blank(int width, int height) {
  Image image(width, height);
  for (const char* name : {"R", "G", "B"})
    std::ranges::fill(image.channel(name).values, 1.0f);
  return image;
}

void blend(Image& image, int x, int y, Rgb color, float share) {
  if (x < 0 || y < 0 || x >= image.width() || y >= image.height()) return;
  image.set_rgb(x, y, image.rgb(x, y) * (1 - share) + color * share);
}

void text_centered(Image& image, int x, int y, const std::string& text, Rgb color) {
  draw_text(image, x - static_cast<int>(text.size()) * letter_width / 2, y, text, color);
}

// A round step that cuts `range` into about `count` parts.
float tick_step(float range, int count) {
  const float raw = range / static_cast<float>(count);
  const float power = std::pow(10.0f, std::floor(std::log10(raw)));
  for (const float factor : {1.0f, 2.0f, 5.0f})
    if (factor * power >= raw) return factor * power;
  return 10 * power;
}

// From values to pixels.
class Axes {
 public:
  Axes(float x_min, float x_max, float y_max)
      : x_min_(x_min), x_max_(x_max), y_max_(y_max) {}
  float px(float x) const {
    return left + (x - x_min_) / (x_max_ - x_min_) * (plot_width - left - right);
  }
  float py(float y) const {
    return plot_height - bottom - y / y_max_ * (plot_height - top - bottom);
  }

  void draw(Image& image) const {
    const float x_step = tick_step(x_max_ - x_min_, 8), y_step = tick_step(y_max_, 6);
    for (float x = std::ceil(x_min_ / x_step) * x_step; x <= x_max_; x += x_step) {
      const int column = static_cast<int>(px(x));
      for (int row = top; row < plot_height - bottom; ++row)
        blend(image, column, row, light_grey, 0.6f);
      text_centered(image, column, plot_height - bottom + 8, fmt::format("{:.4g}", x),
                    dark_grey);
    }
    for (float y = 0; y <= y_max_; y += y_step) {
      const int row = static_cast<int>(py(y));
      for (int column = left; column < plot_width - right; ++column)
        blend(image, column, row, light_grey, 0.6f);
      const std::string text = fmt::format("{:.3g}", y);
      draw_text(image, left - 8 - static_cast<int>(text.size()) * letter_width, row - 3,
                text, dark_grey);
    }
  }

 private:
  float x_min_, x_max_, y_max_;
};

void draw_curve(Image& image, const Axes& axes, const Curve& curve) {
  for (size_t i = 0; i + 1 < curve.x.size(); ++i) {
    const float x0 = axes.px(curve.x[i]), x1 = axes.px(curve.x[i + 1]);
    const float y0 = axes.py(curve.y[i]), y1 = axes.py(curve.y[i + 1]);
    const float steps = std::ceil(std::max({std::abs(x1 - x0), std::abs(y1 - y0), 1.0f}));
    for (float s = 0; s < steps; ++s) {
      const int x = static_cast<int>(x0 + (x1 - x0) * s / steps);
      const float height = std::max(y0 + (y1 - y0) * s / steps, static_cast<float>(top));
      const int y = static_cast<int>(height);
      blend(image, x, y, curve.color, 1);
      blend(image, x, y + 1, curve.color, 1);
    }
    if (!curve.is_filled) continue;
    for (int x = static_cast<int>(x0); x < static_cast<int>(x1); ++x) {
      const float share = (static_cast<float>(x) - x0) / std::max(x1 - x0, 1e-6f);
      const float y = std::max(y0 + (y1 - y0) * share, static_cast<float>(top));
      for (int row = static_cast<int>(y) + 2; row < plot_height - bottom; ++row)
        blend(image, x, row, curve.color, 0.25f);
    }
  }
}

// The value that all but one in fifty of the curve's points stay below.
float usual_maximum(const Curve& curve) {
  std::vector<float> y = curve.y;
  if (y.empty()) return 0;
  const auto at = y.begin() + static_cast<std::ptrdiff_t>((y.size() - 1) * 49 / 50);
  std::nth_element(y.begin(), at, y.end());
  return *at;
}

void draw_legend(Image& image, const std::vector<Curve>& curves) {
  int x = left;
  for (const Curve& curve : curves) {
    for (int i = 0; i < 18; ++i)
      for (int j = 0; j < 3; ++j) blend(image, x + i, 40 + j, curve.color, 1);
    draw_text(image, x + 24, 38, curve.label, black);
    x += 48 + static_cast<int>(curve.label.size()) * letter_width;
  }
}

}  // namespace

Image draw_plot(const std::string& title, const std::string& x_label,
                const std::string& y_label, const std::vector<Curve>& curves) {
  Image image = blank(plot_width, plot_height);
  float x_min = infinity, x_max = -infinity, y_max = 0;
  for (const Curve& curve : curves) {
    if (curve.x.empty()) continue;
    x_min = std::min(x_min, curve.x.front());
    x_max = std::max(x_max, curve.x.back());
    y_max = std::max(y_max, 1.25f * usual_maximum(curve));
  }
  if (!(x_max > x_min)) x_min = 0, x_max = 1;
  if (!(y_max > 0 && y_max < infinity)) y_max = 1;
  const Axes axes(x_min, x_max, y_max);
  axes.draw(image);
  for (const Curve& curve : curves) draw_curve(image, axes, curve);
  draw_text(image, left, 14, title, black);
  draw_legend(image, curves);
  text_centered(image, (left + plot_width - right) / 2, plot_height - 22, x_label, black);
  draw_text(image, 8, 52, y_label, black);
  return image;
}

Image frame_picture(const Image& picture, const std::string& title, const ColorBar& bar) {
  constexpr int margin = 40, bar_height = 12;
  const int width = std::max(picture.width() + 2 * margin, 480);
  Image image = blank(width, picture.height() + 3 * margin);
  draw_text(image, margin, 16, title, black);
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 0; x < picture.width(); ++x)
      image.set_rgb(margin + x, margin + y, picture.rgb(x, y));
  const int row = margin + picture.height() + 16, length = width - 2 * margin;
  for (int x = 0; x < length; ++x)
    for (int y = 0; y < bar_height; ++y)
      image.set_rgb(margin + x, row + y,
                    false_color(static_cast<float>(x) / static_cast<float>(length)));
  constexpr int ticks = 5;
  for (int i = 0; i < ticks; ++i) {
    const float share = static_cast<float>(i) / (ticks - 1);
    text_centered(image, margin + static_cast<int>(share * static_cast<float>(length)),
                  row + bar_height + 6,
                  fmt::format("{:.3g}", bar.low * std::pow(bar.high / bar.low, share)),
                  dark_grey);
  }
  draw_text(image, margin, row + bar_height + 22, bar.label, dark_grey);
  return image;
}

}  // namespace tyndall::app
