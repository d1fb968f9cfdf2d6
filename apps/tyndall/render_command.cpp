// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <stdexcept>

#include "apps/tyndall/commands.h"
#include "apps/tyndall/memory_check.h"
#include "apps/tyndall/progress.h"
#include "apps/tyndall/render_arguments.h"
#include "apps/tyndall/render_metadata.h"
#include "apps/tyndall/render_report.h"
#include "apps/tyndall/scene_input.h"
#include "apps/tyndall/signals.h"
#include "apps/tyndall/write_outputs.h"
#include "tyndall/integrators/render.h"

namespace tyndall::app {

namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

ProgressPrinter make_printer(const RenderArguments& arguments) {
  const bool is_terminal = isatty(STDERR_FILENO) != 0;
  const char* no_color = std::getenv("NO_COLOR");  // any text forbids color: no-color.org
  const bool use_color = is_terminal && (no_color == nullptr || *no_color == '\0');
  const auto style = arguments.quiet
                         ? ProgressStyle::none
                         : choose_progress_style(arguments.progress, is_terminal);
  return {style, stderr, use_color};
}

/// Where the image goes: as asked for, else as the scene says. A single pixel must not
/// overwrite the scene's picture.
std::vector<std::string> output_paths(const RenderArguments& arguments,
                                      const RenderSettings& settings) {
  if (!arguments.outputs.empty()) return arguments.outputs;
  if (arguments.pixel) return {};
  try {
    check_outputs({settings.output});
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(
        fmt::format("{}: the Film's filename: {}", arguments.scene, error.what()));
  }
  return {settings.output};
}

/// No file that is written may be another one, or the scene.
void check_overwrites_nothing(const RenderArguments& arguments,
                              const std::vector<std::string>& outputs) {
  std::vector<std::string> files{arguments.scene};
  files.insert(files.end(), outputs.begin(), outputs.end());
  if (arguments.guiding) files.push_back(*arguments.guiding);
  check_distinct(files);
}

RenderResult run_render(const Scene& scene, const RenderArguments& arguments,
                        const RenderSettings& settings, const StopOnSignal& stop) {
  ProgressPrinter printer = make_printer(arguments);
  RenderOptions options;
  options.threads = arguments.threads;
  options.time_limit = arguments.time_limit;
  options.stop = &stop.flag();
  options.dump_guiding = arguments.guiding.has_value();
  options.on_progress = [&printer](const RenderProgress& progress) {
    printer.update(progress);
  };
  RenderResult result = render(scene, settings, options);
  printer.finish();
  return result;
}

void print_report(const RenderReport& report, const RenderArguments& arguments,
                  const Image& image) {
  if (!arguments.quiet) fmt::print(stderr, "{}", summary(report));
  if (arguments.verbose) fmt::print(stderr, "{}", counter_table(report.statistics));
  if (arguments.stats == "json")
    fmt::print("{}", to_json(report, image));
  else if (arguments.pixel)
    fmt::print("{}", describe_pixel(image));
}

ExitCode render_and_write(const RenderArguments& arguments, const WriteOptions& how,
                          RenderReport report, const Scene& scene) {
  const StopOnSignal stop(arguments.quiet);  // until the outputs are written
  const RenderResult result = run_render(scene, arguments, report.settings, stop);
  report.statistics = result.statistics;
  Image image = result.film.develop();
  add_metadata(image, scene, report.settings, report.statistics, report.scene,
               report.command_line);
  write_outputs(image, report.outputs, how);
  if (arguments.guiding) {
    write_bytes(result.guiding, *arguments.guiding);
    report.outputs.push_back(*arguments.guiding);
  }
  print_report(report, arguments, image);
  return report.statistics.stopped_early ? ExitCode::stopped : ExitCode::done;
}

ExitCode run_render_command(const RenderArguments& arguments,
                            const std::string& command_line) {
  const WriteOptions how = write_options(arguments);
  check_outputs(arguments.outputs);
  check_overwrites_nothing(arguments, arguments.outputs);
  if (arguments.guiding) check_bytes_writable(*arguments.guiding);
  SceneInput input(arguments.scene, arguments.strict, arguments.quiet);
  RenderReport report;
  report.scene = arguments.scene;
  report.command_line = command_line;

  const auto start = std::chrono::steady_clock::now();
  LoadedScene loaded = input.load();
  const Vec2i size_in_file = loaded.settings.resolution;
  apply(arguments, loaded.settings);
  loaded.scene.camera =
      resized(loaded.scene.camera, size_in_file, loaded.settings.resolution);
  report.settings = loaded.settings;
  report.outputs = output_paths(arguments, report.settings);
  check_overwrites_nothing(arguments, report.outputs);
  check_film_fits(report.settings.crop_min, report.settings.crop_max, available_memory());
  report.load_seconds = seconds_since(start);

  const auto build_start = std::chrono::steady_clock::now();
  const Scene scene(std::move(loaded.scene));
  report.build_seconds = seconds_since(build_start);
  input.warn_all(scene.remarks());
  report.warning_count = input.warning_count();

  if (arguments.dry_run) {
    if (!arguments.quiet)
      fmt::print(stderr, "{}: ready to render, {} warnings\n", arguments.scene,
                 report.warning_count);
    return ExitCode::done;
  }
  return render_and_write(arguments, how, std::move(report), scene);
}

}  // namespace

void add_render_command(Program& program) {
  const auto arguments = std::make_shared<RenderArguments>();
  Command command = program.add_command("render", "Render a scene to image files");
  declare_render_arguments(command, *arguments);
  command
      .footer(
          "Example:\n  tyndall render fog.pbrt -o fog.exr -o fog.png --spp 256\n\n"
          "The first Ctrl-C (or SIGTERM) and the time limit end the render and write the\n"
          "outputs; a second Ctrl-C ends at once and writes nothing.\n\n" +
          exit_code_help())
      .on_run([arguments, &program] {
        return run_render_command(*arguments, program.command_line());
      });
}

}  // namespace tyndall::app
