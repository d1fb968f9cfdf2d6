// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>

#include "apps/tyndall/commands.h"
#include "apps/tyndall/comparison.h"

namespace tyndall::app {

namespace {

struct CompareArguments {
  std::vector<std::string> images;
  std::string reference;
  MetricOptions options;
  bool no_flip = false;
  bool json = false;
  std::optional<double> max_rel_mse, max_flip;
};

/// Complains of every image above a limit.
ExitCode check_limit(const Comparison& c, const char* metric, double value,
                     const std::optional<double>& limit) {
  if (!limit || value <= *limit) return ExitCode::done;
  fmt::print(stderr, "error: {}: {} {:.6g} is above {:g}\n", c.path, metric, value, *limit);
  return ExitCode::check_failed;
}

ExitCode check_limits(const ComparisonReport& report, const CompareArguments& arguments) {
  ExitCode code = ExitCode::done;
  for (const Comparison& c : report.comparisons) {
    const ExitCode rel_mse =
        check_limit(c, "relMSE", c.errors.rel_mse, arguments.max_rel_mse);
    const ExitCode flip =
        check_limit(c, "FLIP", c.errors.ldr_flip.value_or(0), arguments.max_flip);
    if (c.errors.not_finite > 0 && (arguments.max_rel_mse || arguments.max_flip)) {
      fmt::print(stderr, "error: {}: {} pixels are not finite\n", c.path,
                 c.errors.not_finite);
      code = ExitCode::check_failed;
    }
    if (rel_mse != ExitCode::done || flip != ExitCode::done) code = ExitCode::check_failed;
  }
  return code;
}

void check_arguments(const CompareArguments& arguments) {
  if (!(arguments.options.epsilon > 0)) {
    throw UsageError(
        fmt::format("--epsilon must be above 0, got {:g}", arguments.options.epsilon));
  }
  if (!(arguments.options.trimmed_fraction >= 0 &&
        arguments.options.trimmed_fraction < 1)) {
    throw UsageError(fmt::format("--trim must lie in [0, 1), got {:g}",
                                 arguments.options.trimmed_fraction));
  }
  if (arguments.no_flip && arguments.max_flip) {
    throw UsageError("--max-flip needs FLIP, which --no-flip leaves out");
  }
}

ExitCode run_compare_command(CompareArguments arguments) {
  check_arguments(arguments);
  arguments.options.with_flip = !arguments.no_flip;
  const ComparisonReport report =
      compare_images(arguments.images, arguments.reference, arguments.options);
  fmt::print("{}", arguments.json ? comparison_json(report) : comparison_table(report));
  return check_limits(report, arguments);
}

}  // namespace

void add_compare_command(Program& program) {
  const auto a = std::make_shared<CompareArguments>();
  program.add_command("compare", "Measure images against a reference")
      .positional("IMAGE", &a->images, "EXR, PNG, PFM or HDR files",
                  {.value = "", .required = true})
      .option("--reference", &a->reference, "what the images should look like",
              {.value = "FILE", .required = true})
      .option("--epsilon", &a->options.epsilon,
              "in relMSE, added to the squared reference [0.01]", {.value = "X"})
      .option("--trim", &a->options.trimmed_fraction,
              "fraction of the pixels that the trimmed relMSE leaves out [0.001]",
              {.value = "X"})
      .option("--exposure", &a->options.exposure,
              "of the images that PSNR and FLIP see [0]", {.value = "STOPS"})
      .flag("--no-flip", &a->no_flip, "leave out FLIP, which is slow")
      .flag("--json", &a->json, "print JSON instead of a table")
      .option("--max-relmse", &a->max_rel_mse,
              "exit with 6 if an image's relMSE is above this", {.value = "X"})
      .option("--max-flip", &a->max_flip, "exit with 6 if an image's FLIP is above this",
              {.value = "X"})
      .footer(
          "Example:\n  tyndall compare a.exr b.exr --reference ref.exr --max-relmse "
          "0.01\n\n" +
          exit_code_help())
      .on_run([a] { return run_compare_command(*a); });
}

}  // namespace tyndall::app
