// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "tyndall/guiding/cell_grid.h"

namespace tyndall {

/// What walks are worth that leave a place in a direction: the square of what they still
/// find, and what they cost. From that follows how likely a walk is to go on [Rath22]: the
/// product of the variance V and the cost C of a path is least where walks survive with
/// probability
///
///     beta sqrt(E[S^2] / c * C / V),
///
/// beta being the throughput, S what the rest of the walk finds for a throughput of one,
/// and c what it costs.
///
/// Places are cells of a box times six directions; where few walks came by, the cell as a
/// whole and the whole box count too. Sums are integers, so that their order does not
/// matter. record() may be called from many threads; update() and clear() from one, while
/// nothing else is called.
class WalkWorth {
 public:
  /// For walks in and around the box, which is not empty.
  explicit WalkWorth(const Bounds3& box);

  /// Number of the place that a walk leaves from p towards w; points beyond the box count
  /// to what is nearest.
  size_t place(Vec3 p, Vec3 w) const;
  size_t places() const { return places_.size(); }
  /// A walk of throughput one that left there found `value`, in units in which one is
  /// typical, and cost so much. Squares above 1e4 count as that.
  void record(size_t place, float value, float cost) const;
  /// Forgets all.
  void clear();
  /// Learns from what was recorded so far. `price` is V / C, in the same units.
  void update(double price);
  /// Nothing was learned yet.
  bool is_empty() const { return survivals_.empty(); }
  /// Of a walk of throughput one, not limited to one. Precondition: not is_empty().
  float survival(size_t place) const { return survivals_[place]; }

  size_t memory() const;  ///< [bytes]

 private:
  struct Tally {
    std::atomic<int64_t> squares = 0, cost = 0, walks = 0;
  };

  CellGrid grid_;
  mutable std::vector<Tally> places_;
  std::vector<float> survivals_;
};

}  // namespace tyndall
