// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

namespace tyndall {

/// The integral of f over [a, b] by adaptive Gauss-Kronrod quadrature; a and b may be
/// infinite. `tolerance` is relative to the integral of |f|. Split the range at
/// discontinuities.
double quadrature(const std::function<double(double)>& f, double a, double b,
                  double tolerance = 1e-9);

}  // namespace tyndall
