// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "tyndall/guiding/byte_stream.h"
#include "tyndall/guiding/distance_codes.h"
#include "tyndall/guiding/light_view.h"

namespace tyndall {

struct VisibilityMapSettings {
  int resolution = 256;    ///< texels per side of the finest level; a power of two
  int rays_per_texel = 4;  ///< a multiple of four
  float floor = 0.05f;     ///< least predicted visibility: the price of being wrong
  uint64_t seed = 0;
  float edge_depth = 0.1f;   ///< jumps of the distance that matter [scene units]
  bool lit_outside = false;  ///< what to expect out of the view: light, or none
};

/// Predicts which share of a light a point sees, from rays that were traced out of the
/// light.
///
/// A texel keeps four quantiles of the distances at which its rays met an occluder; what it
/// predicts for a distance is the share of them that lie beyond. A pyramid of such texels
/// predicts the mean over wider footprints. A prediction may be wrong; it costs variance,
/// never bias, because it is never below the floor.
class VisibilityMap {
 public:
  /// How far from the light what leaves it along `ray` gets; infinity if nothing stops it,
  /// zero where the light does not shine. An area light chooses one of its points by `u`.
  using Trace = std::function<float(const Ray& ray, Vec2 u)>;

  /// Everything visible, until traced. Sizes: 20 bytes a texel, all levels 4/3 of the
  /// finest.
  VisibilityMap(const LightView& view, const VisibilityMapSettings& settings);

  int rows() const { return resolution_; }
  /// Traces rows [begin, end) of the finest level. Different rows may be traced by
  /// different threads; the result does not depend on how they are divided.
  void trace_rows(int begin, int end, const Trace& trace);
  /// Builds the coarser levels; to be called once all rows are traced.
  void finish();

  /// Instead of tracing all rows: first the rows of a level sketch_factor times coarser,
  /// all of them, then the finest rows, where only texels near an edge of the sketch are
  /// traced; the others take over what it found. A tenth to a third of the rays, for nearly
  /// the same map.
  static constexpr int sketch_factor = 4;
  int sketch_rows() const { return std::max(resolution_ / sketch_factor, 1); }
  void sketch_row(int row, const Trace& trace);
  void refine_rows(int begin, int end, const Trace& trace);

  /// Share of the light that the point sees, in [floor, 1]; the mean over a texel of
  /// `level`.
  float visibility(Vec3 p, int level = 0) const;
  /// The same for the points ray.at(t[i]); a few nanoseconds each. `out` is as long as `t`.
  void visibility(const Ray& ray, std::span<const float> t, std::span<float> out,
                  int level = 0) const;

  int levels() const { return static_cast<int>(level_offset_.size()); }
  /// The level whose texels are about `footprint` wide: an angle seen from the light [rad],
  /// or a length for parallel light. In equi-angular bins that angle is the same for all
  /// bins.
  int level_of(float footprint) const;
  /// Of a texel of the finest level: at which distances its rays met an occluder,
  /// ascending; infinity where none did, zero where the light does not shine.
  const std::array<float, 4>& distances(int x, int y) const {
    return texels_[static_cast<size_t>(y * resolution_ + x)];
  }
  float floor() const { return floor_; }
  const LightView& view() const { return view_; }
  size_t memory() const {  ///< [bytes]
    return texels_.size() * (sizeof(Texel) + sizeof(DistanceCodes::Four));
  }

  /// Appends the view, the resolution, the floor, and four distances a texel of the finest
  /// level.
  void write(ByteWriter& out) const;
  /// Empty if what it reads is no map.
  static std::optional<VisibilityMap> read(ByteReader& in);

 private:
  using Texel = std::array<float, 4>;  // distances, ascending

  Texel trace_texel(int x, int y, int side, const Trace& trace) const;
  bool is_edge(int x, int y) const;
  size_t offset_of(int side) const;
  void encode();
  int32_t out_of_cone() const { return static_cast<int32_t>(texels_.size()) - 1; }

  LightView view_;
  int resolution_, rays_per_texel_;
  float floor_, edge_depth_;
  float texels_per_extent_;  // of the finest level, over what LightView::extent() says
  uint64_t seed_;
  std::vector<int32_t> level_offset_;
  std::vector<Texel>
      texels_;  // finest level first; the last one stands for "out of the cone"
  DistanceCodes codes_;
  std::vector<DistanceCodes::Four> coded_;  // the texels, for look-ups
};

}  // namespace tyndall
