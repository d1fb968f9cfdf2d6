// SPDX-License-Identifier: Apache-2.0
#include "apps/tyndall/bench/bench_scene.h"

#include <fmt/format.h>

#include <filesystem>
#include <limits>
#include <stdexcept>

#include "apps/tyndall/exit_code.h"
#include "apps/tyndall/render_metadata.h"
#include "apps/tyndall/scene_input.h"
#include "apps/tyndall/shell_line.h"
#include "apps/tyndall/write_outputs.h"
#include "tyndall/image/io.h"
#include "tyndall/math/scalar.h"

namespace tyndall::app {

namespace {

// Far from the seeds of runs, so that no run shares its noise with the reference.
constexpr uint64_t reference_seed = 1'000'000'007;

void load(BenchScene& bench, const BenchPlan& plan) {
  SceneInput input(bench.path, false, plan.quiet);
  LoadedScene loaded = input.load();
  const Vec2i size_in_file = loaded.settings.resolution;
  apply(plan.render, loaded.settings);
  loaded.scene.camera =
      resized(loaded.scene.camera, size_in_file, loaded.settings.resolution);
  bench.settings = loaded.settings;
  bench.settings.samples_per_pixel = std::numeric_limits<uint32_t>::max() / 4;
  bench.scene = std::make_unique<Scene>(std::move(loaded.scene));
}

/// Renders the reference with the first method and writes it; false if stopped.
bool make_reference(const BenchScene& bench, const BenchPlan& plan, const std::string& path,
                    const std::atomic<bool>& stop) {
  const RenderSettings settings = run_settings(bench, plan.methods.front(), reference_seed);
  RenderOptions options;
  options.threads = plan.render.threads;
  options.time_limit = plan.reference_time.value_or(10 * plan.time_limit);
  options.stop = &stop;
  if (!plan.quiet) {
    fmt::print(stderr, "{}: rendering the reference for {:g} s with {}\n", bench.name,
               *options.time_limit, settings.integrator);
  }
  const RenderResult result = render(*bench.scene, settings, options);
  if (stop) return false;
  Image image = result.film.develop();
  add_metadata(image, *bench.scene, settings, result.statistics, bench.path, "");
  write_outputs(image, {path}, {});
  return true;
}

Image read_reference(const BenchScene& bench, const std::string& path) {
  Image image = read_image(path);
  const Vec2i size = bench.settings.crop_max - bench.settings.crop_min;
  if (image.width() != size.x || image.height() != size.y) {
    throw std::runtime_error(
        fmt::format("{}: the reference has {} x {} pixels, the picture {} x {}", path,
                    image.width(), image.height(), size.x, size.y));
  }
  if (!image.has_rgb()) {
    throw std::runtime_error(path + ": the reference has no R, G and B channels");
  }
  return image;
}

double samples_of(const Image& image) {
  const auto found = image.numbers.find("samplesPerPixel");
  return found == image.numbers.end() ? 0 : double{found->second};
}

}  // namespace

std::optional<BenchScene> prepare_scene(const std::string& path, const std::string& name,
                                        const BenchPlan& plan, const BenchStore& store,
                                        const std::atomic<bool>& stop) {
  BenchScene bench{name, path, nullptr, {}, {}, {}};
  load(bench, plan);
  const std::string own_file = name + "-reference.exr";
  const std::string file = plan.reference ? *plan.reference : store.path(own_file);
  if (!plan.reference && !std::filesystem::exists(file)) {
    if (!plan.make_reference) {
      throw UsageError(
          fmt::format("{}: no reference; give --reference FILE or --make-reference", path));
    }
    if (!make_reference(bench, plan, file, stop)) return std::nullopt;
  }
  bench.reference = read_reference(bench, file);
  SceneResults& d = bench.description;
  d.name = name;
  d.path = path;
  d.hash = file_hash(path);
  d.width = bench.reference.width();
  d.height = bench.reference.height();
  d.reference = plan.reference ? std::filesystem::absolute(file).string() : own_file;
  d.reference_samples_per_pixel = samples_of(bench.reference);
  d.reference_rel_mse = own_rel_mse(bench.reference, plan.epsilon);
  return bench;
}

RenderSettings run_settings(const BenchScene& scene, const Method& method, uint64_t seed) {
  RenderSettings settings = scene.settings;
  settings.integrator = method.integrator;
  settings.seed = seed;
  for (const auto& [name, value] : method.options) settings.options[name] = value;
  return settings;
}

std::string render_command(const BenchScene& scene, const BenchPlan& plan,
                           const Method& method, const Run& run) {
  std::vector<std::string> words = {"tyndall", "render", scene.path, "--integrator",
                                    method.integrator};
  const auto add = [&](const std::string& name, const std::string& value) {
    words.insert(words.end(), {name, value});
  };
  for (const auto& [name, value] : plan.render.assignments)
    add("--set", fmt::format("{}={}", name, value));
  for (const auto& [name, value] : method.options)
    add("--set", fmt::format("{}={}", name, value));
  if (plan.render.size) {
    add("--size", fmt::format("{}x{}", plan.render.size->x, plan.render.size->y));
  }
  if (plan.render.max_depth) add("--maxdepth", fmt::format("{}", *plan.render.max_depth));
  add("--seed", fmt::format("{}", run.seed));
  add("--spp", fmt::format("{}", run.samples_per_pixel));
  add("-o", run.image);
  std::vector<const char*> pointers;
  pointers.reserve(words.size());
  for (const std::string& word : words) pointers.push_back(word.c_str());
  return shell_line(static_cast<int>(pointers.size()), pointers.data());
}

std::optional<double> own_rel_mse(const Image& reference, double epsilon) {
  if (!reference.has_rgb("variance")) return std::nullopt;
  const RgbPlanes r = reference.rgb_planes(), variance = reference.rgb_planes("variance");
  double sum = 0;
  for (size_t i = 0; i < reference.pixel_count(); ++i) {
    if (!is_finite(r[i]) || !is_finite(variance[i])) continue;
    for (int c = 0; c < 3; ++c) {
      sum += double{variance[i][c]} / (sqr(double{r[i][c]}) + epsilon);
    }
  }
  return sum / (3 * static_cast<double>(reference.pixel_count()));
}

}  // namespace tyndall::app
