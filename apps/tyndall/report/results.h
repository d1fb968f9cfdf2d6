// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tyndall/image/bias_test.h"
#include "tyndall/image/metrics.h"

/// What `tyndall bench` measures, as docs/results-format.md describes it.
namespace tyndall::app {

/// The error at one moment of a run.
struct Checkpoint {
  double seconds = 0;  ///< of rendering, training included, measuring excluded
  uint32_t samples_per_pixel = 0;
  double mse = 0, rel_mse = 0, rel_mse_trimmed = 0;
};

/// One render with one seed.
struct Run {
  uint64_t seed = 0;
  double seconds = 0, training_seconds = 0, cpu_seconds = 0;
  uint32_t samples_per_pixel = 0;
  int64_t paths = 0, rejected_samples = 0;
  /// Of the process during the run, scene and reference included; empty if unknown.
  std::optional<double> peak_memory_bytes;
  std::vector<Checkpoint> checkpoints;  ///< in time
  ImageErrors errors;                   ///< of the last image
  std::optional<BiasTest> bias;
  std::string image;                       ///< file, relative to the results file
  std::map<std::string, double> counters;  ///< the integrator's, by dotted name
  std::vector<std::string> notes;
  std::string command;  ///< renders the same image
};

/// An integrator with its options.
struct Method {
  std::string name, integrator;
  std::map<std::string, std::string> options;
  std::vector<Run> runs;  ///< by seed
};

struct SceneResults {
  std::string name, path;
  std::string hash;  ///< of the scene file's bytes
  int width = 0, height = 0;
  std::string reference;  ///< file, relative to the results file
  double reference_samples_per_pixel = 0;
  /// The expected relMSE of the reference against the truth, from its variance layer.
  std::optional<double> reference_rel_mse;
  std::vector<Method> methods;
};

struct Machine {
  std::string cpu, system;
  int cores = 0;
  double memory_bytes = 0;
};

struct Results {
  std::string created;  ///< UTC, ISO 8601
  std::string command, program, commit, compiler, flags;
  Machine machine;
  int threads = 0;
  double time_limit = 0;  ///< [s] of each run
  double epsilon = 0.01;  ///< of relMSE
  std::vector<SceneResults> scenes;
};

std::string to_json(const Results& results);

/// Throws std::runtime_error with a sentence that names what is missing or wrong.
Results results_from_json(const std::string& text);

/// results_from_json() of a file, whose name stands before the sentence.
Results read_results(const std::string& path);

}  // namespace tyndall::app
