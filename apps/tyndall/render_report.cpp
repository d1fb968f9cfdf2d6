// SPDX-License-Identifier: Apache-2.0
#include "apps/tyndall/render_report.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/tyndall/progress.h"
#include "apps/tyndall/version.h"

namespace tyndall::app {

namespace {

double per_second(int64_t count, double seconds) {
  return seconds > 0 ? static_cast<double>(count) / seconds : 0;
}

nlohmann::json pair(Vec2i v) { return {v.x, v.y}; }
nlohmann::json triple(Rgb c) { return {c.r, c.g, c.b}; }

/// Standard errors from the variance layer.
Rgb standard_error(const Image& image, int x, int y) {
  if (!image.has_rgb("variance")) return Rgb(0);
  const Rgb variance = image.rgb(x, y, "variance");
  return {std::sqrt(variance.r), std::sqrt(variance.g), std::sqrt(variance.b)};
}

/// "1.23 million", "45.1 thousand", "35".
std::string in_words(double count) {
  if (count >= 1e6) return fmt::format("{:.3g} million", count * 1e-6);
  if (count >= 1e3) return fmt::format("{:.3g} thousand", count * 1e-3);
  return fmt::format("{:.0f}", count);
}

}  // namespace

int64_t peak_memory() {
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<int64_t>(usage.ru_maxrss) * 1024;
}

std::string summary(const RenderReport& report) {
  const RenderStatistics& s = report.statistics;
  const Vec2i size = report.settings.resolution;
  std::string text = fmt::format(
      "{}x{}, {} spp, {} with {} threads, {} paths/s, {:.0f} MB\n", size.x, size.y,
      s.samples_per_pixel, format_seconds(s.seconds), s.threads,
      in_words(per_second(s.paths, s.seconds)), static_cast<double>(peak_memory()) / 1e6);
  if (s.rejected.total() > 0)
    text += fmt::format(
        "warning: {} samples rejected: {} not a number, {} infinite, {} negative\n",
        s.rejected.total(), s.rejected.not_a_number, s.rejected.infinite,
        s.rejected.negative);
  for (const std::string& note : s.notes) text += fmt::format("note: {}\n", note);
  if (s.stopped_early)
    text += fmt::format("stopped early: {} of {} samples per pixel\n", s.samples_per_pixel,
                        report.settings.samples_per_pixel);
  for (const std::string& output : report.outputs)
    text += fmt::format("wrote {}\n", output);
  return text;
}

std::string counter_table(const RenderStatistics& statistics) {
  std::string text;
  for (const auto& [name, value] : statistics.counters)
    text += fmt::format("  {:<40} {:g}\n", name, value);
  return text;
}

std::string to_json(const RenderReport& report, const Image& image) {
  const RenderStatistics& s = report.statistics;
  const RenderSettings& settings = report.settings;
  nlohmann::ordered_json json = {
      {"version", version_name()},
      {"command_line", report.command_line},
      {"scene", report.scene},
      {"integrator", settings.integrator},
      {"resolution", pair(settings.resolution)},
      {"crop", {pair(settings.crop_min), pair(settings.crop_max)}},
      {"seed", settings.seed},
      {"max_depth", settings.max_depth},
      {"samples_per_pixel", s.samples_per_pixel},
      {"samples_per_pixel_wanted", settings.samples_per_pixel},
      {"unsampled_pixels", s.unsampled_pixels},
      {"stopped_early", s.stopped_early},
      {"threads", s.threads},
      {"seconds", s.seconds},
      {"training_seconds", s.training_seconds},
      {"cpu_seconds", s.cpu_seconds},
      {"load_seconds", report.load_seconds},
      {"build_seconds", report.build_seconds},
      {"paths", s.paths},
      {"paths_per_second", per_second(s.paths, s.seconds)},
      {"peak_memory_bytes", peak_memory()},
      {"rejected",
       {{"not_a_number", s.rejected.not_a_number},
        {"infinite", s.rejected.infinite},
        {"negative", s.rejected.negative}}},
      {"warnings", report.warning_count},
      {"counters", s.counters},
      {"notes", s.notes},
      {"outputs", report.outputs},
  };
  if (image.pixel_count() == 1)
    json["pixel"] = {{"rgb", triple(image.rgb(0, 0))},
                     {"standard_error", triple(standard_error(image, 0, 0))}};
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

std::string describe_pixel(const Image& image) {
  const Rgb value = image.rgb(0, 0), error = standard_error(image, 0, 0);
  return fmt::format("pixel {},{}: {:g} {:g} {:g} +- {:.2g} {:.2g} {:.2g}\n",
                     image.offset.x, image.offset.y, value.r, value.g, value.b, error.r,
                     error.g, error.b);
}

}  // namespace tyndall::app
