// SPDX-License-Identifier: Apache-2.0
#include "apps/tyndall/report/insets.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "tyndall/image/metrics.h"

namespace tyndall::app {

namespace {

struct Candidate {
  Inset inset;
  double error;
};

std::vector<double> error_sums(const std::vector<const Image*>& images,
                               const Image& reference) {
  std::vector<double> sums(reference.pixel_count());
  for (const Image* image : images) {
    const std::vector<float> errors = relative_square_errors(*image, reference, 0.01);
    for (size_t i = 0; i < sums.size(); ++i) {
      if (!std::isnan(errors[i])) sums[i] += std::min(double{errors[i]}, 1.0);
    }
  }
  return sums;
}

double sum_inside(const std::vector<double>& values, const Image& place,
                  const Inset& inset) {
  double sum = 0;
  for (int y = inset.y; y < inset.y + inset.size; ++y) {
    for (int x = inset.x; x < inset.x + inset.size; ++x) sum += values[place.index(x, y)];
  }
  return sum;
}

bool overlap(const Inset& a, const Inset& b) {
  return std::abs(a.x - b.x) < a.size && std::abs(a.y - b.y) < a.size;
}

}  // namespace

std::vector<Inset> choose_insets(const std::vector<const Image*>& images,
                                 const Image& reference, int count) {
  const int smaller = std::min(reference.width(), reference.height());
  const int size = std::clamp(smaller / 8, std::min(smaller, 24), 96);
  const int step = std::max(size / 4, 1);
  const std::vector<double> errors = error_sums(images, reference);
  std::vector<Candidate> candidates;
  for (int y = 0; y + size <= reference.height(); y += step) {
    for (int x = 0; x + size <= reference.width(); x += step) {
      const Inset inset{x, y, size};
      candidates.push_back({inset, sum_inside(errors, reference, inset)});
    }
  }
  std::stable_sort(
      candidates.begin(), candidates.end(),
      [](const Candidate& a, const Candidate& b) { return a.error > b.error; });
  std::vector<Inset> chosen;
  for (const Candidate& c : candidates) {
    const bool is_free = std::none_of(chosen.begin(), chosen.end(),
                                      [&](const Inset& i) { return overlap(i, c.inset); });
    if (is_free && static_cast<int>(chosen.size()) < count) chosen.push_back(c.inset);
  }
  return chosen;
}

Image cut_out(const Image& image, const Inset& inset) {
  Image result(inset.size, inset.size);
  for (int y = 0; y < inset.size; ++y) {
    for (int x = 0; x < inset.size; ++x) {
      result.set_rgb(x, y, image.rgb(inset.x + x, inset.y + y));
    }
  }
  return result;
}

}  // namespace tyndall::app
