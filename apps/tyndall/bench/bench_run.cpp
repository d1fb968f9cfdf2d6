// SPDX-License-Identifier: Apache-2.0
#include "apps/tyndall/bench/bench_run.h"

#include <chrono>

#include "apps/tyndall/bench/peak_memory.h"

namespace tyndall::app {

namespace {

/// Wall time without the pauses.
class RunClock {
 public:
  void pause() { before_ += since_resumed(); }
  void resume() { resumed_ = Clock::now(); }
  /// Precondition: paused.
  double seconds() const { return before_; }

 private:
  using Clock = std::chrono::steady_clock;

  double since_resumed() const {
    return std::chrono::duration<double>(Clock::now() - resumed_).count();
  }

  Clock::time_point resumed_ = Clock::now();
  double before_ = 0;
};

/// What a render calls after each pass.
class CheckpointRecorder {
 public:
  CheckpointRecorder(const Image& reference, const RunOptions& options)
      : reference_(reference), options_(options) {
    metrics_ = options.metrics;
    metrics_.with_flip = false;
  }

  void on_pass(const Film& film, uint32_t samples) {
    clock_.pause();
    const double last_pass = clock_.seconds() - pass_end_;
    pass_end_ = clock_.seconds();
    // A pass later the end would be further from the limit.
    const bool is_over = clock_.seconds() + 0.5 * last_pass >= options_.time_limit;
    if (clock_.seconds() >= next_ && !is_over) {
      record(measure_errors(film.develop(), reference_, metrics_), samples);
      next_ = interval_growth * clock_.seconds();
    }
    if (is_over || options_.stop->load()) stop_ = true;
    clock_.resume();
  }

  void record(const ImageErrors& errors, uint32_t samples) {
    checkpoints_.push_back(
        {clock_.seconds(), samples, errors.mse, errors.rel_mse, errors.rel_mse_trimmed});
  }

  const std::atomic<bool>& stop() const { return stop_; }
  double seconds() const { return clock_.seconds(); }
  std::vector<Checkpoint> take_checkpoints() { return std::move(checkpoints_); }

 private:
  static constexpr double interval_growth = 1.3;

  const Image& reference_;
  RunOptions options_;
  MetricOptions metrics_;
  RunClock clock_;
  std::atomic<bool> stop_ = false;
  double next_ = 0, pass_end_ = 0;
  std::vector<Checkpoint> checkpoints_;
};

Run describe(const RenderStatistics& statistics, const RenderSettings& settings) {
  Run run;
  run.seed = settings.seed;
  run.training_seconds = statistics.training_seconds;
  run.cpu_seconds = statistics.cpu_seconds;
  run.samples_per_pixel = statistics.samples_per_pixel;
  run.paths = statistics.paths;
  run.rejected_samples = statistics.rejected.total();
  run.counters = statistics.counters;
  run.notes = statistics.notes;
  return run;
}

}  // namespace

std::optional<MeasuredRun> measure_run(const Scene& scene, const RenderSettings& settings,
                                       const Image& reference, const RunOptions& options) {
  CheckpointRecorder recorder(reference, options);
  RenderOptions render_options;
  render_options.threads = options.threads;
  render_options.stop = &recorder.stop();
  render_options.on_pass = [&](const Film& film, uint32_t samples) {
    recorder.on_pass(film, samples);
  };
  reset_peak_memory();
  RenderResult result = render(scene, settings, render_options);
  const std::optional<double> peak_memory = peak_memory_since_reset();
  if (options.stop->load()) return std::nullopt;
  MeasuredRun measured{describe(result.statistics, settings), std::move(result.statistics),
                       result.film.develop()};
  Run& run = measured.run;
  run.seconds = recorder.seconds();
  run.peak_memory_bytes = peak_memory;
  run.errors = measure_errors(measured.image, reference, options.metrics);
  run.bias = test_bias(measured.image, reference);
  recorder.record(run.errors, run.samples_per_pixel);
  run.checkpoints = recorder.take_checkpoints();
  return measured;
}

}  // namespace tyndall::app
