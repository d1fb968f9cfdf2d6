// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "tyndall/math/statistics.h"

namespace tyndall {

/// The level of each of `tests` independent tests that together reject a true hypothesis
/// with probability `alpha` [Sidak67].
double sidak(double alpha, int tests);

/// Two-sided p-value of a mean whose distribution is normal. Without any spread, one if the
/// mean is exactly as expected and else zero.
double z_p_value(double mean, double standard_error, double expected);
double z_p_value(const RunningMoments& samples, double expected);

/// Two-sided p-value of the hypothesis that two samples have the same mean [Welch47].
double welch_p_value(const RunningMoments& a, const RunningMoments& b);

/// p-value of the hypothesis that the numbers are independent and uniform in [0, 1], by the
/// Kolmogorov-Smirnov statistic with the small-sample correction of [Stephens70].
double uniformity_p_value(std::span<const double> values);

}  // namespace tyndall
