// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "apps/tyndall/bench/bench_run.h"
#include "apps/tyndall/bench/bench_scene.h"
#include "apps/tyndall/commands.h"
#include "apps/tyndall/render_metadata.h"
#include "apps/tyndall/report/efficiency.h"
#include "apps/tyndall/signals.h"
#include "apps/tyndall/text_table.h"
#include "apps/tyndall/write_outputs.h"

namespace tyndall::app {

namespace {

/// The scenes of a plan, measured run by run.
class Bench {
 public:
  Bench(const BenchPlan& plan, const std::string& command_line)
      : plan_(plan), stop_(plan.quiet), store_(plan, command_line) {}

  /// False if a signal ended it early.
  bool run() {
    const std::vector<std::string> names = scene_names(plan_.scenes);
    for (size_t i = 0; i < names.size(); ++i) {
      auto scene = prepare_scene(plan_.scenes[i], names[i], plan_, store_, stop_.flag());
      if (!scene) return false;
      store_.scene(scene->description);
      scenes_.push_back(std::move(*scene));
    }
    return run_all_seeds();
  }

  const Results& results() const { return store_.results(); }

 private:
  /// Methods in the innermost loop: whatever slows the machine down for a while slows all.
  bool run_all_seeds() {
    for (int seed = 0; seed < plan_.seeds; ++seed) {
      for (const BenchScene& scene : scenes_) {
        for (const Method& method : plan_.methods) {
          if (!run_once(scene, method, static_cast<uint64_t>(seed))) return false;
        }
      }
    }
    return true;
  }

  /// False if stopped. Does nothing for a run that is there.
  bool run_once(const BenchScene& scene, const Method& wanted, uint64_t seed) {
    ++count_;
    Method& method = store_.method(store_.scene(scene.description), wanted);
    if (store_.has_run(method, seed)) return true;
    const RenderSettings settings = run_settings(scene, method, seed);
    RunOptions options{plan_.time_limit, plan_.render.threads, {}, &stop_.flag()};
    options.metrics.epsilon = plan_.epsilon;
    options.metrics.with_flip = !plan_.no_flip;
    auto measured = measure_run(*scene.scene, settings, scene.reference, options);
    if (!measured) return false;
    Run& run = measured->run;
    run.image = fmt::format("{}-{}-{}.exr", scene.name, file_name(method.name), seed);
    run.command = render_command(scene, plan_, method, run);
    add_metadata(measured->image, *scene.scene, settings, measured->statistics, scene.path,
                 run.command);
    write_outputs(measured->image, {store_.path(run.image)}, {.half = true});
    method.runs.push_back(run);
    store_.save();
    tell(scene, method, run);
    return true;
  }

  /// A method's name as part of a file's name.
  static std::string file_name(std::string name) {
    for (char& c : name) {
      if (c == '/' || c == ':' || c == '=') c = '_';
    }
    return name;
  }

  void tell(const BenchScene& scene, const Method& method, const Run& run) const {
    if (plan_.quiet) return;
    const size_t total =
        static_cast<size_t>(plan_.seeds) * scenes_.size() * plan_.methods.size();
    fmt::print(stderr, "[{}/{}] {} {} seed {}: {:.1f} s, {} samples/pixel, relMSE {:.4g}\n",
               count_, total, scene.name, method.name, run.seed, run.seconds,
               run.samples_per_pixel, run.errors.rel_mse);
  }

  const BenchPlan& plan_;
  const StopOnSignal stop_;
  BenchStore store_;
  std::vector<BenchScene> scenes_;
  size_t count_ = 0;
};

std::vector<std::string> summary_row(const Method& method, const Method& baseline) {
  const auto mean = [&](double (*value)(const Run&)) {
    return short_number(spread_over_runs(method.runs, value).mean);
  };
  return {method.name,
          fmt::format("{}", method.runs.size()),
          mean([](const Run& r) { return r.errors.rel_mse; }),
          mean([](const Run& r) { return r.errors.rel_mse_trimmed; }),
          mean([](const Run& r) { return r.seconds; }),
          mean([](const Run& r) { return double{1} * r.samples_per_pixel; }),
          ratio_text(method, baseline, cost_in_time),
          ratio_text(method, baseline, trimmed_cost_in_time),
          ratio_text(method, baseline, cost_in_samples)};
}

/// What was measured, for the terminal.
std::string summary(const Results& results) {
  std::string text;
  for (const SceneResults& scene : results.scenes) {
    if (scene.methods.empty()) continue;
    const Method& baseline = scene.methods.front();
    std::vector<std::vector<std::string>> rows = {
        {scene.name, "runs", "relMSE", "trimmed", "seconds", "samples/pixel",
         "times less time", "trimmed", "times fewer samples"}};
    std::string sentences;
    for (const Method& method : scene.methods) {
      rows.push_back(summary_row(method, baseline));
      const std::string sentence = time_sentence(method, baseline);
      if (&method == &baseline || sentence.empty()) continue;
      sentences += fmt::format("{}: {}\n", method.name, sentence);
    }
    text += text_table(rows) + "\n" + sentences;
    if (!sentences.empty() && is_reference_noisy(scene)) {
      text += fmt::format(
          "the reference's own relMSE of {:.2g} is part of these errors: the true ratios "
          "are "
          "further from 1\n",
          *scene.reference_rel_mse);
    }
  }
  return text;
}

ExitCode run_bench_command(const BenchPlan& plan, const std::string& command_line) {
  check_plan(plan);
  Bench bench(plan, command_line);
  const bool finished = bench.run();
  fmt::print("{}", summary(bench.results()));
  if (finished) {
    fmt::print("see all of it: tyndall report {0} -o {0}/report.html\n", plan.folder);
    return ExitCode::done;
  }
  fmt::print(stderr, "stopped; the same command goes on with the runs that are missing\n");
  return ExitCode::stopped;
}

void declare_arguments(Command& command, BenchPlan& plan) {
  command
      .positional("SCENE", &plan.scenes, "pbrt-v4 scene files",
                  {.value = "", .required = true})
      .option("--integrators", ArgumentParser([&plan](const std::string& s) {
                plan.methods = parse_methods(s);
              }),
              "what to measure, the baseline first; options after colons "
              "[volpath,jis,learned]",
              {.value = "A,B:NAME=VALUE,..."})
      .option("--time", ArgumentParser([&plan](const std::string& s) {
                plan.time_limit = parse_duration(s);
              }),
              "time of each run [30s]", {.value = "DURATION"})
      .option("--seeds", ArgumentParser([&plan](const std::string& s) {
                plan.seeds = parse_whole_number(s, 1);
              }),
              "runs of each integrator [5]", {.value = "N"})
      .option("--reference", &plan.reference, "what the picture should look like",
              {.value = "FILE"})
      .flag(
          "--make-reference", &plan.make_reference,
          "render the references that the output folder does not hold yet, with the first "
          "integrator")
      .option("--reference-time", ArgumentParser([&plan](const std::string& s) {
                plan.reference_time = parse_duration(s);
              }),
              "time of a reference [10 times --time]", {.value = "DURATION"})
      .option("-o,--output", &plan.folder,
              "folder of results.json and the images [results]", {.value = "FOLDER"})
      .option("--size", ArgumentParser([&plan](const std::string& s) {
                plan.render.size = parse_size(s);
              }),
              "size of the picture", {.value = "WxH"})
      .option("--maxdepth", ArgumentParser([&plan](const std::string& s) {
                plan.render.max_depth = parse_depth(s);
              }),
              "scattering vertices of a path", {.value = "N"})
      .option("--set", ArgumentParser([&plan](const std::string& s) {
                plan.render.assignments.push_back(parse_assignment(s));
              }),
              "option of all integrators; may be repeated",
              {.value = "NAME=VALUE", .repeatable = true})
      .option("--threads", ArgumentParser([&plan](const std::string& s) {
                plan.render.threads = parse_threads(s);
              }),
              "how many [all]", {.value = "N"})
      .option("--epsilon", &plan.epsilon, "in relMSE [0.01]", {.value = "X"})
      .flag("--no-flip", &plan.no_flip, "leave out FLIP, which is slow")
      .flag("-q,--quiet", &plan.quiet, "print no progress");
}

/// Those of the usual three that this build has.
std::vector<Method> default_methods() {
  std::vector<Method> methods;
  const std::vector<std::string> known = integrator_names();
  for (const char* name : {"volpath", "jis", "learned"}) {
    if (std::count(known.begin(), known.end(), name) > 0)
      methods.push_back({name, name, {}, {}});
  }
  return methods;
}

}  // namespace

void add_bench_command(Program& program) {
  const auto plan = std::make_shared<BenchPlan>();
  Command command =
      program.add_command("bench", "Measure integrators against one another at equal time");
  declare_arguments(command, *plan);
  command
      .footer(
          "Example:\n  tyndall bench fog.pbrt --integrators volpath,learned --time 30s "
          "--seeds 5 "
          "--make-reference\n\nRuns that the output folder already holds are not run "
          "again.\n\n" +
          exit_code_help())
      .on_run([plan, &program] {
        if (plan->methods.empty()) plan->methods = default_methods();
        return run_bench_command(*plan, program.command_line());
      });
}

}  // namespace tyndall::app
