// SPDX-License-Identifier: Apache-2.0
#include "tyndall/integrators/render.h"

#include <sys/resource.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <mutex>
#include <stdexcept>

#include "tyndall/integrators/integrator.h"
#include "tyndall/integrators/particle_pass.h"
#include "tyndall/math/parallel_for.h"

namespace tyndall {
namespace {

constexpr int tile_size = 8;
constexpr double progress_interval = 0.1;  // [s]
// A pass is the least that a stopped render finishes: keep it short.
constexpr double target_pass_seconds = 1.0;
constexpr uint32_t max_pass_growth = 2;

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

// L with no component above `max`, its color kept. What is not finite is left to the film.
Rgb limited(Rgb L, float max) {
  const float largest = max_component(L);
  return largest > max && is_finite(L) ? L * (max / largest) : L;
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
    statistics_.paths = static_cast<int64_t>(done_) * pixel_count();
    statistics_.rejected = film_.rejected();
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

  int64_t pixel_count() const {
    const Vec2i size = settings_.crop_max - settings_.crop_min;
    return static_cast<int64_t>(size.x) * size.y;
  }

  void run_passes() {
    uint32_t allowed = 0;  // by the integrator, until it prepares again
    while (done_ < settings_.samples_per_pixel) {
      if (done_ > 0 && must_stop()) {
        statistics_.stopped_early = true;
        return;
      }
      if (done_ >= allowed) {
        const double before = clock_.seconds();
        allowed = integrator_->prepare(done_);
        statistics_.training_seconds += clock_.seconds() - before;
      }
      uint32_t end = allowed;
      if (ParticleTracer* particles = integrator_->particles())
        end = std::min(end, particle_pass_.prepare(*particles, done_, film_));
      const uint32_t count = std::min(next_pass_size(), end - done_);
      render_pass({done_, count});
      done_ += count;
      if (options_.on_pass) options_.on_pass(film_, done_);
    }
  }

  bool must_stop() const {
    if (options_.stop && options_.stop->load(std::memory_order_relaxed)) return true;
    return options_.time_limit && clock_.seconds() >= *options_.time_limit;
  }

  // Sizes depend on the clock, images do not: a pixel's samples are the same however they
  // are cut into passes.
  uint32_t next_pass_size() {
    const uint32_t left = settings_.samples_per_pixel - done_;
    if (done_ == 0) return 1;
    double seconds = target_pass_seconds;
    if (options_.time_limit)
      seconds = std::min(seconds, *options_.time_limit - clock_.seconds());
    const double fitting = std::max(1.0, seconds / seconds_per_sample_);
    const uint32_t limit = std::min(max_pass_growth * last_pass_, left);
    last_pass_ = fitting < limit ? static_cast<uint32_t>(fitting) : limit;
    return last_pass_;
  }

  void render_pass(Pass pass) {
    const double start = clock_.seconds();
    finished_pixels_ = 0;
    const Vec2i size = settings_.crop_max - settings_.crop_min;
    const int columns = (size.x + tile_size - 1) / tile_size,
              rows = (size.y + tile_size - 1) / tile_size;
    parallel_for(static_cast<size_t>(columns) * static_cast<size_t>(rows), [&](size_t i) {
      const auto tile = static_cast<int>(i);
      render_tile({tile % columns, tile / columns}, pass);
    });
    if (ParticleTracer* particles = integrator_->particles())
      for (uint32_t i = pass.first; i < pass.first + pass.count; ++i)
        particle_pass_.run(*particles, i, film_);
    seconds_per_sample_ = std::max((clock_.seconds() - start) / pass.count, 1e-9);
  }

  void render_tile(Vec2i tile, Pass pass) {
    const Vec2i first = settings_.crop_min + Vec2i{tile.x * tile_size, tile.y * tile_size};
    const Vec2i last{std::min(first.x + tile_size, settings_.crop_max.x),
                     std::min(first.y + tile_size, settings_.crop_max.y)};
    for (int y = first.y; y < last.y; ++y)
      for (int x = first.x; x < last.x; ++x)
        for (uint32_t i = pass.first; i < pass.first + pass.count; ++i)
          render_sample({x, y}, i);
    const int64_t pixels = int64_t{last.x - first.x} * (last.y - first.y);
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

  // `samples` count the begun ones too. A pass may go on beyond the time limit: what is not
  // finished is never told to be.
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
  double cpu_start_ = process_cpu_seconds();
  std::unique_ptr<Integrator> integrator_;
  Filter filter_;
  ParticlePass particle_pass_;
  Film film_;
  RenderStatistics statistics_;
  uint32_t done_ = 0, last_pass_ = 1;
  double seconds_per_sample_ = 0;
  std::atomic<int64_t> finished_pixels_ = 0;
  std::mutex progress_mutex_;
  double last_progress_ = 0;
};

}  // namespace

RenderResult render(const Scene& scene, const RenderSettings& settings,
                    const RenderOptions& options) {
  return RenderJob(scene, settings, options).run();
}

}  // namespace tyndall
