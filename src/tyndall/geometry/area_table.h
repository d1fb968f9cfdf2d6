// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tyndall {

/// A primitive drawn in proportion to its area.
struct PrimitiveChoice {
  uint32_t primitive;
  float u_remapped;  ///< uniform in [0, 1), for reuse
};

/// The areas of a shape's primitives, for choosing one in proportion to its area.
class AreaTable {
 public:
  void reserve(size_t n) { sums_.reserve(n); }
  /// Areas that are not finite count as zero.
  void append(double area);
  double total() const { return sums_.empty() ? 0 : sums_.back(); }
  /// Never a primitive without area. Precondition: total() > 0.
  PrimitiveChoice choose(float u) const;

 private:
  std::vector<double> sums_;  // of each and all before, in double: there may be millions
};

}  // namespace tyndall
