// SPDX-License-Identifier: Apache-2.0
#include "support/quadrature.h"

#include <boost/math/quadrature/gauss_kronrod.hpp>

namespace tyndall {

double quadrature(const std::function<double(double)>& f, double a, double b,
                  double tolerance) {
  constexpr unsigned max_depth = 15;
  return boost::math::quadrature::gauss_kronrod<double, 31>::integrate(f, a, b, max_depth,
                                                                       tolerance);
}

}  // namespace tyndall
