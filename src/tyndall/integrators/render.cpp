// SPDX-License-Identifier: Apache-2.0
#include "tyndall/integrators/render.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <mutex>
#include <stdexcept>

#include "tyndall/integrators/integrator.h"
#include "tyndall/integrators/particle_pass.h"
#include "tyndall/integrators/pixel_lattice.h"
#include "tyndall/math/parallel_for.h"

namespace tyndall {
namespace {

constexpr double progress_interval = 0.1;  // [s]
// A pass that is stopped leaves pixels with different numbers of samples: keep it short.
constexpr double target_pass_seconds = 1.0;
constexpr uint32_t max_pass_growth = 2;
// A pass may take so many times as long as the one before lets expect.
constexpr double pass_tolerance = 1.25;
// What samples and particles of the first pass get each, or a share of it, even if
// preparation took all of the time.
constexpr double least_first_seconds = 0.25;
// The share of the time for the first pass that particles may take.
constexpr double first_particles_share = 0.25;

class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

double process_cpu_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

struct Pass {
  uint32_t first, count;  // samples of each pixel
};

// One render() call: the passes, their sizes, and what is told of them.
class RenderJob {
 public:
  RenderJob(const Scene& scene, const RenderSettings& settings,
            const RenderOptions& options)
      : scene_(scene),
        settings_(settings),
        options_(options),
        filter_(settings.filter),
        particle_pass_(filter_, settings),
        film_(settings.resolution, settings.crop_min, settings.crop_max) {}

  RenderResult run() {
    tbb::task_arena arena(options_.threads > 0 ? options_.threads
                                               : tbb::task_arena::automatic);
    // An arena of more slots than the default concurrency needs workers to fill them.
    const tbb::global_control workers(tbb::global_control::max_allowed_parallelism,
                                      static_cast<size_t>(arena.max_concurrency()));
    arena.execute([&] {
      prepare_integrator();
      run_passes();
    });
    if (options_.on_progress) report_progress(done_, done_);
    statistics_.threads = arena.max_concurrency();
    statistics_.seconds = clock_.seconds();
    statistics_.cpu_seconds = process_cpu_seconds() - cpu_start_;
    statistics_.samples_per_pixel = done_;
    statistics_.paths = paths_;
    statistics_.rejected = film_.rejected();
    report_unsampled();
    statistics_.counters["camera.media"] =
        static_cast<double>(scene_.camera_media().size());
    integrator_->report(statistics_);
    return {std::move(film_), std::move(statistics_), dump_guiding()};
  }

 private:
  void prepare_integrator() {
    integrator_ = make_integrator(scene_, settings_);
    statistics_.training_seconds = clock_.seconds();
    if (options_.dump_guiding && !integrator_->learns())
      throw std::invalid_argument("integrator \"" + settings_.integrator +
                                  "\" learns nothing that could be dumped");
  }

  std::vector<std::byte> dump_guiding() const {
    if (!options_.dump_guiding) return {};
    ByteWriter bytes;
    GuidingFileWriter file(bytes);
    file.add_times(statistics_.seconds, statistics_.training_seconds);
    file.add_scene(SceneMark::of(scene_));
    integrator_->dump(file);
    file.finish();
    return bytes.bytes();
  }

  void report_unsampled() {
    const int64_t count = statistics_.unsampled_pixels = film_.unsampled();
    if (count == 0) return;
    const double share = static_cast<double>(count) / static_cast<double>(pixel_count());
    statistics_.notes.push_back(
        fmt::format("stopped before each pixel had a sample: {} of {} ({:.1f} %) show what "
                    "a pixel nearby "
                    "found",
                    count, pixel_count(), 100 * share));
  }

  int64_t pixel_count() const {
    const Vec2i size = settings_.crop_max - settings_.crop_min;
    return static_cast<int64_t>(size.x) * size.y;
  }

  void run_passes() {
    uint32_t allowed = 0;  // by the integrator, until it prepares again
    while (done_ < settings_.samples_per_pixel) {
      if (done_ > 0 && deadline_.has_passed()) {
        statistics_.stopped_early = true;
        return;
      }
      if (done_ >= allowed) {
        const double before = clock_.seconds();
        allowed = integrator_->prepare(done_, deadline_);
        statistics_.training_seconds += clock_.seconds() - before;
      }
      uint32_t end = allowed;
      if (ParticleTracer* particles = integrator_->particles())
        end = std::min(end, particle_pass_.prepare(*particles, done_, film_, deadline_));
      const uint32_t count = std::min(next_pass_size(), end - done_);
      if (!render_pass({done_, count})) {
        statistics_.stopped_early = true;
        return;
      }
      done_ += count;
      if (options_.on_pass) options_.on_pass(film_, done_);
    }
  }

  // Sizes depend on the clock, images do not: a pixel's samples are the same however they
  // are cut into passes.
  uint32_t next_pass_size() {
    const uint32_t left = settings_.samples_per_pixel - done_;
    if (done_ == 0) return 1;
    const double seconds = std::min(target_pass_seconds, deadline_.seconds_left());
    const double fitting = std::max(1.0, seconds / seconds_per_sample_);
    const uint32_t limit = std::min(max_pass_growth * last_pass_, left);
    last_pass_ = fitting < limit ? static_cast<uint32_t>(fitting) : limit;
    return last_pass_;
  }

  // Whether it was finished before the deadline.
  bool render_pass(Pass pass) {
    const double start = clock_.seconds();
    const bool is_first = pass.first == 0;
    // Those of the first sample must not be missing, and so come first.
    if (is_first) run_particles(pass, first_deadline().in_share(first_particles_share));
    if (!render_pixels(pass, is_first ? first_deadline() : deadline_)) return false;
    if (!is_first) run_particles(pass, deadline_);
    seconds_per_sample_ = std::max((clock_.seconds() - start) / pass.count, 1e-9);
    return true;
  }

  Deadline first_deadline() const { return deadline_.at_least(least_first_seconds); }

  void run_particles(Pass pass, const Deadline& deadline) {
    if (const ParticleTracer* particles = integrator_->particles())
      for (uint32_t i = pass.first; i < pass.first + pass.count; ++i)
        particle_pass_.run(*particles, i, film_, deadline);
  }

  // Whether each pixel was. Which ones were does not depend on what they found.
  bool render_pixels(Pass pass, const Deadline& deadline) {
    finished_pixels_ = 0;
    for (const PixelLattice& lattice : pixel_order(pass))
      parallel_for(lattice.tiles(), [&](size_t tile) {
        if (!deadline.has_passed()) render_tile(lattice, tile, pass);
      });
    return finished_pixels_ == pixel_count();
  }

  std::vector<PixelLattice> pixel_order(Pass pass) const {
    const double expected = pass_tolerance * pass.count * seconds_per_sample_;
    const bool may_be_cut =
        deadline_.is_set() && (pass.first == 0 || expected > deadline_.seconds_left());
    return may_be_cut ? pixels_from_coarse_to_fine(settings_.crop_min, settings_.crop_max)
                      : all_pixels(settings_.crop_min, settings_.crop_max);
  }

  void render_tile(const PixelLattice& lattice, size_t tile, Pass pass) {
    const int64_t pixels = lattice.for_pixels(tile, [&](Vec2i pixel) {
      for (uint32_t i = pass.first; i < pass.first + pass.count; ++i)
        render_sample(pixel, i);
    });
    paths_ += pixels * pass.count;
    tell_progress(pass, finished_pixels_ += pixels);
  }

  void render_sample(Vec2i pixel, uint32_t index) {
    Sampler sampler(settings_.sampler, settings_.seed, pixel, index);
    const FilterSample offset = filter_.sample(sampler.next_2d());
    const Vec2 p_film =
        Vec2{static_cast<float>(pixel.x) + 0.5f, static_cast<float>(pixel.y) + 0.5f} +
        offset.offset;
    const Vec2 u_lens =
        scene_.camera().settings().lens_radius > 0 ? sampler.next_2d() : Vec2{0.5f, 0.5f};
    PathSample sample = integrator_->Li(scene_.camera().ray(p_film, u_lens), sampler);
    sample.L = limited(sample.L * settings_.imaging_ratio, settings_.max_component);
    film_.add(pixel, sample, offset.weight);
  }

  void tell_progress(Pass pass, int64_t finished_pixels) {
    // The next pass or the end tells of a pass that is complete.
    if (!options_.on_progress || finished_pixels == pixel_count()) return;
    const std::unique_lock lock(progress_mutex_, std::try_to_lock);
    if (!lock || clock_.seconds() - last_progress_ < progress_interval) return;
    const double of_pass =
        static_cast<double>(finished_pixels) / static_cast<double>(pixel_count());
    report_progress(pass.first + of_pass * pass.count, pass.first);
  }

  // `samples` count the begun ones too. What is not finished is never told to be.
  void report_progress(double samples, uint32_t finished) {
    const double now = last_progress_ = clock_.seconds();
    double fraction = samples / settings_.samples_per_pixel;
    if (options_.time_limit) fraction = std::max(fraction, now / *options_.time_limit);
    fraction = std::min(fraction, samples > finished ? 0.99 : 1.0);
    const bool is_known = fraction > 0 && !statistics_.stopped_early;
    options_.on_progress({.fraction = fraction,
                          .seconds = now,
                          .seconds_remaining = is_known ? now / fraction - now : 0,
                          .samples = finished,
                          .phase = "rendering"});
  }

  const Scene& scene_;
  const RenderSettings& settings_;
  const RenderOptions& options_;
  // Both clocks run while the integrator is made: it traces what its lights see.
  Stopwatch clock_;
  Deadline deadline_ = Deadline::in(options_.time_limit.value_or(infinity), options_.stop);
  double cpu_start_ = process_cpu_seconds();
  std::unique_ptr<Integrator> integrator_;
  Filter filter_;
  ParticlePass particle_pass_;
  Film film_;
  RenderStatistics statistics_;
  uint32_t done_ = 0, last_pass_ = 1;
  double seconds_per_sample_ = 0;
  std::atomic<int64_t> finished_pixels_ = 0, paths_ = 0;
  std::mutex progress_mutex_;
  double last_progress_ = 0;
};

}  // namespace

RenderResult render(const Scene& scene, const RenderSettings& settings,
                    const RenderOptions& options) {
  return RenderJob(scene, settings, options).run();
}

}  // namespace tyndall
