// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tyndall/image/bias_test.h"
#include "tyndall/image/metrics.h"

namespace tyndall::app {

/// One image measured against the reference.
struct Comparison {
  std::string path;
  ImageErrors errors;
  std::optional<BiasTest> bias;  ///< empty without a variance layer
};

/// Several images measured against one reference.
struct ComparisonReport {
  std::string reference;
  int width = 0, height = 0;
  MetricOptions options;
  std::vector<Comparison> comparisons;
};

/// Reads and measures. Throws UsageError if the reference is one of the images, and
/// std::runtime_error with the path for an image that cannot be read or compared.
ComparisonReport compare_images(const std::vector<std::string>& images,
                                const std::string& reference, const MetricOptions& options);

/// A table for the terminal, with what its numbers mean and what was left out.
std::string comparison_table(const ComparisonReport& report);
/// One JSON object; docs/results-format.md lists its fields.
std::string comparison_json(const ComparisonReport& report);

}  // namespace tyndall::app
