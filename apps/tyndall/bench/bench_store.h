// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "apps/tyndall/bench/bench_plan.h"
#include "apps/tyndall/report/results.h"

namespace tyndall::app {

/// The folder of a benchmark: results.json, and the images that it names. Saved after each
/// run, so that a stopped benchmark can go on.
class BenchStore {
 public:
  /// Takes over what the folder already holds; makes the folder if it is not there. Throws
  /// UsageError if what it holds was measured under other conditions, OutputError if the
  /// folder cannot be written.
  BenchStore(const BenchPlan& plan, const std::string& command_line);

  const Results& results() const { return results_; }
  std::string path(const std::string& file) const;

  /// The scene of that name, added if it is not there. Throws UsageError if it was measured
  /// with another file, size or reference.
  SceneResults& scene(const SceneResults& wanted);
  Method& method(SceneResults& scene, const Method& wanted);
  bool has_run(const Method& method, uint64_t seed) const;

  void save();

 private:
  void check_conditions(const BenchPlan& plan) const;

  std::string folder_;
  Results results_;
};

}  // namespace tyndall::app
