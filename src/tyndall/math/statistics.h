// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>

namespace tyndall {

/// Running mean and variance of a stream of numbers [Welford62]; merges exactly.
class RunningMoments {
 public:
  void add(double x) {
    ++count_;
    const double delta = x - mean_;
    mean_ += delta / static_cast<double>(count_);
    sum_squares_ += delta * (x - mean_);
  }

  void merge(const RunningMoments& o) {
    if (o.count_ == 0) return;
    const double n = static_cast<double>(count_ + o.count_);
    const double delta = o.mean_ - mean_;
    sum_squares_ += o.sum_squares_ + delta * delta * static_cast<double>(count_) *
                                         static_cast<double>(o.count_) / n;
    mean_ += delta * static_cast<double>(o.count_) / n;
    count_ += o.count_;
  }

  int64_t count() const { return count_; }
  double mean() const { return mean_; }
  /// Unbiased variance of one sample; zero below two samples.
  double variance() const {
    return count_ < 2 ? 0 : sum_squares_ / static_cast<double>(count_ - 1);
  }
  /// Standard error of mean(); zero below two samples.
  double standard_error() const {
    return count_ < 2 ? 0 : std::sqrt(variance() / static_cast<double>(count_));
  }

 private:
  int64_t count_ = 0;
  double mean_ = 0;
  double sum_squares_ = 0;
};

}  // namespace tyndall
