// SPDX-License-Identifier: Apache-2.0
#include "apps/tyndall/memory_check.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>

#include "apps/tyndall/exit_code.h"

namespace tyndall::app {

namespace {

// A pixel's running sums in the film, its 18 channels in the finished image and those in
// the file.
constexpr int64_t bytes_per_pixel = 88 + 72 + 72;

std::string format_bytes(int64_t bytes) {
  const double gigabytes = static_cast<double>(bytes) / 1e9;
  return gigabytes < 1 ? fmt::format("{:.0f} MB", gigabytes * 1e3)
                       : fmt::format("{:.0f} GB", gigabytes);
}

}  // namespace

int64_t available_memory() {
  const int64_t machine =
      static_cast<int64_t>(sysconf(_SC_PHYS_PAGES)) * sysconf(_SC_PAGESIZE);
  std::ifstream file("/sys/fs/cgroup/memory.max");  // "max" without a limit
  int64_t limit = 0;
  return file >> limit && limit > 0 ? std::min(limit, machine) : machine;
}

void check_film_fits(Vec2i crop_min, Vec2i crop_max, int64_t available) {
  const int64_t width = crop_max.x - crop_min.x, height = crop_max.y - crop_min.y;
  // In floating point first: the product of large sides overflows 64 bits.
  const double needed =
      static_cast<double>(width) * static_cast<double>(height) * bytes_per_pixel;
  if (needed <= static_cast<double>(available)) return;
  throw ResourceError(
      fmt::format("a film of {}x{} pixels needs {}, more than the {} of memory here; see "
                  "--size and --crop",
                  width, height,
                  needed < 9e18 ? format_bytes(static_cast<int64_t>(needed)) : "too much",
                  format_bytes(available)));
}

}  // namespace tyndall::app
