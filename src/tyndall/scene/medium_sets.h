// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>

#include "tyndall/media/medium.h"

namespace tyndall {

/// The media that light is in at once, one Medium for each combination that occurs. Which
/// they are is known from the boundaries it has crossed: each takes away the medium that it
/// states for the side that light comes from, and adds the one of the other side. Nested
/// boundaries that name their exterior, as pbrt-v4 wants them, so lead from one medium to
/// the next; boundaries that name none overlap with what is there.
///
/// A medium that light has entered twice, through boundaries that overlap, is there once
/// until it is left twice. Safe to use from all threads; what it returns stays where it is.
class MediumSets {
 public:
  /// `media` must outlive it.
  explicit MediumSets(std::span<const Medium> media);
  ~MediumSets();

  /// The media behind a boundary that states `from` before it and `to` behind it, for light
  /// that was in `current`; all three null for empty space. Where light was not in `from`,
  /// the boundary is believed and not the past.
  const Medium* cross(const Medium* current, const Medium* from, const Medium* to) const {
    // What happens nearly always.
    return current == from ? to : cross_overlap(current, from, to);
  }
  /// Whether `current` contains `medium`, one of `media`.
  bool contains(const Medium* current, const Medium* medium) const;

 private:
  class Impl;
  const Medium* cross_overlap(const Medium* current, const Medium* from,
                              const Medium* to) const;

  std::unique_ptr<Impl> impl_;
};

}  // namespace tyndall
