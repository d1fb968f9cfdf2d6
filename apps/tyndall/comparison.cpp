// SPDX-License-Identifier: Apache-2.0
#include "apps/tyndall/comparison.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "apps/tyndall/exit_code.h"
#include "apps/tyndall/metrics_json.h"
#include "apps/tyndall/text_table.h"
#include "tyndall/image/io.h"

namespace tyndall::app {

namespace {

bool is_same_file(const std::string& a, const std::string& b) {
  std::error_code ignored;
  return a == b || std::filesystem::equivalent(a, b, ignored);
}

Comparison compare(const std::string& path, const Image& reference,
                   const MetricOptions& options) {
  const Image image = read_image(path);
  try {
    return {path, measure_errors(image, reference, options), test_bias(image, reference)};
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(fmt::format("{}: {}", path, error.what()));
  }
}

std::string optional_number(const std::optional<double>& x) {
  return x ? short_number(*x) : "-";
}

std::vector<std::string> table_row(const Comparison& c) {
  const ImageErrors& e = c.errors;
  std::vector<std::string> row = {c.path,
                                  short_number(e.rel_mse),
                                  short_number(e.rel_mse_trimmed),
                                  short_number(e.mse),
                                  short_number(e.smape),
                                  fmt::format("{:.2f}", e.psnr),
                                  optional_number(e.ldr_flip),
                                  optional_number(e.hdr_flip),
                                  short_number(e.percentile_99_9)};
  if (c.bias) {
    row.push_back(fmt::format("{:+.2g} +- {:.1g}", c.bias->mean_difference,
                              1.96 * c.bias->standard_error));
    row.push_back(fmt::format("{:.2g}", c.bias->p_value));
    row.push_back(fmt::format("{}/{}", c.bias->rejected_tiles, c.bias->tiles));
  } else {
    row.insert(row.end(), {"-", "-", "-"});
  }
  return row;
}

/// Sentences about what the table leaves out.
std::string remarks(const ComparisonReport& report) {
  std::string text;
  for (const Comparison& c : report.comparisons) {
    if (c.errors.not_finite > 0) {
      text += fmt::format("{}: {} pixels are not finite and left out\n", c.path,
                          c.errors.not_finite);
    }
    if (!c.bias) text += fmt::format("{}: no variance layer, so no bias test\n", c.path);
  }
  if (report.comparisons.empty()) return text;
  const Comparison& first = report.comparisons.front();
  if (first.errors.reference_not_finite > 0) {
    text += fmt::format("{}: {} pixels are not finite and left out\n", report.reference,
                        first.errors.reference_not_finite);
  }
  if (first.bias && !first.bias->reference_has_variance) {
    text += fmt::format("{}: no variance layer; the bias test takes it as exact\n",
                        report.reference);
  }
  return text;
}

nlohmann::json comparison_object(const Comparison& c) {
  nlohmann::json object = write_json(c.errors);
  object["path"] = c.path;
  object["bias"] = write_json(c.bias);
  return object;
}

}  // namespace

ComparisonReport compare_images(const std::vector<std::string>& images,
                                const std::string& reference,
                                const MetricOptions& options) {
  for (const std::string& path : images) {
    if (is_same_file(path, reference)) {
      throw UsageError(
          fmt::format("the reference {} is also one of the images", reference));
    }
  }
  const Image reference_image = read_image(reference);
  ComparisonReport report{
      reference, reference_image.width(), reference_image.height(), options, {}};
  for (const std::string& path : images) {
    report.comparisons.push_back(compare(path, reference_image, options));
  }
  return report;
}

std::string comparison_table(const ComparisonReport& report) {
  std::vector<std::vector<std::string>> rows = {{"image", "relMSE", "trimmed", "MSE",
                                                 "SMAPE", "PSNR", "FLIP", "HDR-FLIP",
                                                 "99.9 %", "bias", "p", "tiles"}};
  for (const Comparison& c : report.comparisons) rows.push_back(table_row(c));
  return fmt::format(
             "reference: {} ({} x {})\n"
             "relMSE with epsilon {}; trimmed: without the worst {:g} % of the pixels; "
             "PSNR and FLIP\n"
             "of sRGB at exposure {:g}; bias: difference of the means with 95 % "
             "confidence, its\n"
             "p-value, and tiles that differ at 5 % for all together\n\n",
             report.reference, report.width, report.height, report.options.epsilon,
             100 * report.options.trimmed_fraction, report.options.exposure) +
         text_table(rows) + remarks(report);
}

std::string comparison_json(const ComparisonReport& report) {
  nlohmann::json images = nlohmann::json::array();
  for (const Comparison& c : report.comparisons) images.push_back(comparison_object(c));
  const nlohmann::json object = {{"reference", report.reference},
                                 {"width", report.width},
                                 {"height", report.height},
                                 {"epsilon", report.options.epsilon},
                                 {"trimmed_fraction", report.options.trimmed_fraction},
                                 {"exposure", report.options.exposure},
                                 {"images", images}};
  return object.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace tyndall::app
