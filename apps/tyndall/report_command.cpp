// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "apps/tyndall/commands.h"
#include "apps/tyndall/report/error_curve.h"
#include "apps/tyndall/report/report_page.h"
#include "tyndall/image/whole_file.h"

namespace tyndall::app {

namespace {

struct ReportArguments {
  std::vector<std::string> results;
  std::string output = "report.html";
  std::optional<std::string> plots;
};

/// A folder stands for the results.json in it.
std::string results_file(const std::string& path) {
  const bool is_folder = std::filesystem::is_directory(path);
  return is_folder ? (std::filesystem::path(path) / "results.json").string() : path;
}

/// A folder as a page in another file sees it.
std::string seen_from(const std::string& page, const std::filesystem::path& folder) {
  const auto absolute = [](const std::filesystem::path& path) {
    return std::filesystem::absolute(path).lexically_normal();
  };
  return absolute(folder / ".").lexically_relative(absolute(page).parent_path()).string();
}

ReportInput read_input(const std::string& path, const std::string& page) {
  const std::string file = results_file(path);
  const std::filesystem::path folder = std::filesystem::path(file).parent_path();
  ReportInput input{read_results(file), folder.string(), seen_from(page, folder)};
  for (const SceneResults& scene : input.results.scenes) {
    const bool has_runs = !scene.methods.empty() && !scene.methods.front().runs.empty();
    if (!has_runs) {
      throw std::runtime_error(
          fmt::format("{}: scene \"{}\" has no finished runs", file, scene.name));
    }
  }
  if (input.results.scenes.empty())
    throw std::runtime_error(file + ": there are no scenes");
  return input;
}

void write_text(const std::string& path, const std::string& text) {
  try {
    write_whole_file(path, text);
  } catch (const std::runtime_error& error) {
    throw OutputError(error.what());
  }
}

void check_output(const std::string& path) {
  try {
    check_can_write_file(path);
  } catch (const std::runtime_error& error) {
    throw OutputError(error.what());
  }
}

void write_plot(const std::string& path, const std::string& element) {
  if (!element.starts_with("<svg")) return;
  write_text(path, svg_file(element));
  fmt::print("wrote {}\n", path);
}

void write_plots(const std::string& folder, const std::vector<ReportInput>& inputs) {
  for (const ReportInput& input : inputs) {
    for (const SceneResults& scene : input.results.scenes) {
      const ScenePlots plots = scene_plots(scene, input.results.time_limit);
      const std::string path = (std::filesystem::path(folder) / scene.name).string();
      write_plot(path + "-time.svg", plots.time);
      write_plot(path + "-samples.svg", plots.samples);
    }
  }
}

ExitCode run_report_command(const ReportArguments& arguments) {
  check_output(arguments.output);
  std::vector<ReportInput> inputs;
  for (const std::string& path : arguments.results) {
    inputs.push_back(read_input(path, arguments.output));
  }
  const std::string page = report_page(inputs);
  write_text(arguments.output, page);
  fmt::print("wrote {} ({:.1f} MB)\n", arguments.output,
             static_cast<double>(page.size()) / 1e6);
  if (arguments.plots) write_plots(*arguments.plots, inputs);
  return ExitCode::done;
}

}  // namespace

void add_report_command(Program& program) {
  const auto a = std::make_shared<ReportArguments>();
  program.add_command("report", "Show what bench measured in one HTML page")
      .positional("RESULTS", &a->results,
                  "results.json files, or the folders that hold them",
                  {.value = "", .required = true})
      .option("-o,--output", &a->output, "the page [report.html]", {.value = "FILE"})
      .option("--plots", &a->plots, "write the error plots here too, as SVG files",
              {.value = "FOLDER"})
      .footer("Example:\n  tyndall report results -o report.html\n\n" + exit_code_help())
      .on_run([a] { return run_report_command(*a); });
}

}  // namespace tyndall::app
