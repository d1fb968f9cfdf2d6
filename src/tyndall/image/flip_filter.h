// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

namespace tyndall::flip {

/// A plane of numbers.
struct Plane {
  int width, height;
  std::vector<float> values;

  size_t index(int x, int y) const {
    return static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x);
  }
};

/// One Gaussian of a contrast sensitivity function, a sqrt(pi / b) exp(-pi^2 x^2 / b) in
/// the distance x [degrees] [Andersson20, Table 1].
struct Sensitivity {
  double a, b;
};

/// Filters as the eye does at a distance [Andersson20, Sec. 4.1.1]. A sum of two Gaussians
/// is not separable, each of them is; together they have unit sum.
Plane filter_by_sensitivity(const Plane& in, const std::vector<Sensitivity>& terms,
                            double pixels_per_degree);

/// The strengths of edges and of points in the lightness of an image.
struct Features {
  Plane edges, points;
};

/// [Andersson20, Sec. 4.2.1]; lightness in [0, 1].
Features find_features(const Plane& lightness, double pixels_per_degree);

}  // namespace tyndall::flip
