// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "apps/tyndall/report/results.h"

namespace tyndall::app {

/// A ratio with its 95 % confidence interval.
struct RatioEstimate {
  double ratio = 1, low = 1, high = 1;
};

/// The cost of an error: relMSE times what was spent on it.
using RunCost = double (*)(const Run&);
double cost_in_time(const Run& run);
double cost_in_samples(const Run& run);
/// With the relMSE that leaves out the worst pixels.
double trimmed_cost_in_time(const Run& run);

/// The geometric mean of the baseline's costs over that of the method's: how many times
/// less the method spends for the same error. The interval is Welch's [Welch47] for the
/// difference of the mean logarithms. Empty with fewer than two runs of either, or a cost
/// that is not above zero.
std::optional<RatioEstimate> cost_ratio(const std::vector<Run>& method,
                                        const std::vector<Run>& baseline, RunCost cost);

/// The 97.5 % quantile of Student's distribution; degrees of freedom are rounded down to
/// the next of a table, which errs to the wide side by at most 2 % from 3 on.
double student_quantile_975(double degrees_of_freedom);

/// Mean and sample standard deviation of a value over runs.
struct Spread {
  double mean = 0, deviation = 0;
};
Spread spread_over_runs(const std::vector<Run>& runs, double (*value)(const Run&));

}  // namespace tyndall::app
