// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/tyndall/report/results.h"

namespace tyndall::app {

struct ConfidenceInterval {
  double low = 1, high = 1;
};

/// A ratio with its 95 % confidence interval.
struct RatioEstimate {
  double ratio = 1;
  std::optional<ConfidenceInterval> interval;  ///< empty if there are too few runs for one

  /// "2.59 (2.1 to 3.2)"
  std::string text() const;
  /// "2.59 times less time (95 % confidence: 2.1 to 3.2)", or, below one, "1.3 times the
  /// time".
  std::string time_words() const;
};

/// The cost of an error: relMSE times what was spent on it.
using RunCost = double (*)(const Run&);
double cost_in_time(const Run& run);
double cost_in_samples(const Run& run);
/// With the relMSE that leaves out the worst pixels.
double trimmed_cost_in_time(const Run& run);

/// The geometric mean of the baseline's costs over that of the method's: how many times
/// less the method spends for the same error. The interval is Welch's [Welch47] for the
/// difference of the mean logarithms, and needs two runs of each. Empty without runs, or
/// with a cost that is not above zero.
std::optional<RatioEstimate> cost_ratio(const std::vector<Run>& method,
                                        const std::vector<Run>& baseline, RunCost cost);

/// cost_ratio() as text: "1" for the baseline itself, "-" where there is none.
std::string ratio_text(const Method& method, const Method& baseline, RunCost cost);

/// "the same error as volpath in 13 times less time; without the worst 0.1 % of the pixels
/// in 9 times less time". Empty where there is no ratio. The second part is what remains
/// where a few fireflies make the error.
std::string time_sentence(const Method& method, const Method& baseline);

/// Whether the reference's own noise is more than a tenth of the smallest error measured
/// with it, so that true ratios are further from one than the measured ones.
bool is_reference_noisy(const SceneResults& scene);

/// The 97.5 % quantile of Student's distribution; degrees of freedom are rounded down to
/// the next of a table, which errs to the wide side by at most 2 % from 3 on.
double student_quantile_975(double degrees_of_freedom);

/// Mean and sample standard deviation of a value over runs.
struct Spread {
  double mean = 0, deviation = 0;
};
Spread spread_over_runs(const std::vector<Run>& runs, double (*value)(const Run&));

}  // namespace tyndall::app
