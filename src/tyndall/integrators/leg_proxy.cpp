// SPDX-License-Identifier: Apache-2.0
#include "tyndall/integrators/leg_proxy.h"

#include <algorithm>
#include <cmath>

#include "tyndall/techniques/fast_log.h"

namespace tyndall {

LegProxy::LegProxy(Leg& leg) {
  float depth = 0;
  for (size_t i = 0; const Leg::Span* span = leg.span(i); ++i) {
    if (!span->medium) continue;
    const Ray rest{leg.ray().at(span->t_min), leg.ray().d};
    span->medium->visit([&](const auto& medium) {
      auto segments = medium.segments(rest, span->t_max - span->t_min);
      MediumSegment s;
      while (segments.next(s)) {
        const float sigma_t = average(s.mean);
        if (!(sigma_t > 0) || !(s.t_min < s.t_max)) continue;
        pieces_.push_back(
            {span->t_min + s.t_min, span->t_min + s.t_max, sigma_t, depth, span->medium});
        depth += sigma_t * (s.t_max - s.t_min);
      }
    });
  }
  if (pieces_.empty()) return;
  t_min_ = pieces_.front().t_min;
  t_max_ = pieces_.back().t_max;
}

void LegProxy::Cursor::move_to(float t) {
  const auto& pieces = proxy_->pieces_;
  while (piece_ + 1 < pieces.size() && t >= pieces[piece_ + 1].t_min) ++piece_;
  if (pieces.empty()) return;
  const Piece& piece = pieces[piece_];
  const float inside = std::clamp(t - piece.t_min, 0.0f, piece.t_max - piece.t_min);
  const bool is_inside = t >= piece.t_min && t <= piece.t_max;
  sigma_t_ = is_inside ? piece.sigma_t : 0;
  medium_ = is_inside ? piece.medium : nullptr;
  depth_ = piece.depth + piece.sigma_t * inside;
}

float LegProxy::collision_pdf_t(float t) const {
  Cursor cursor(*this);
  cursor.move_to(t);
  return cursor.sigma_t() * cursor.transmittance();
}

std::optional<DistanceSample> LegProxy::sample(float u, float share) const {
  if (!(share > 0)) return std::nullopt;
  const float depth = -std::log1p(-u * share);
  for (const Piece& piece : pieces_) {
    if (piece.end_depth() < depth && &piece != &pieces_.back()) continue;
    const float inside = std::max(depth - piece.depth, 0.0f) / piece.sigma_t;
    const float t = std::min(piece.t_min + inside, piece.t_max);
    const float pdf = density_or_zero(piece.sigma_t * std::exp(-depth) / share);
    if (!(pdf > 0)) return std::nullopt;
    return DistanceSample{.t = t, .pdf_t = pdf};
  }
  return std::nullopt;
}

void LegProxy::sample_roughly(std::span<float> u, float share) const {
  // Of thin media, whose transmittance is all but one, two terms say more.
  const bool is_thin = share < 1e-2f;
  for (float& x : u) {
    const float lost = x * share;
    x = is_thin ? lost + 0.5f * lost * lost : -fast_log(1 - lost);
  }
  size_t i = 0;
  for (float& x : u) {
    while (i + 1 < pieces_.size() && pieces_[i].end_depth() < x) ++i;
    const float inside = std::max(x - pieces_[i].depth, 0.0f) / pieces_[i].sigma_t;
    x = std::min(pieces_[i].t_min + inside, pieces_[i].t_max);
  }
}

float LegProxy::collision_share(float t) const {
  Cursor cursor(*this);
  cursor.move_to(t);
  return -std::expm1(-cursor.depth());
}

float LegProxy::transmittance(float t) const {
  Cursor cursor(*this);
  cursor.move_to(t);
  return cursor.transmittance();
}

const Medium* LegProxy::medium_at(float t) const {
  Cursor cursor(*this);
  cursor.move_to(t);
  return cursor.medium();
}

float LegProxy::distance_to(float level) const {
  const float depth = -std::log(level);
  for (const Piece& piece : pieces_)
    if (piece.end_depth() >= depth)
      return piece.t_min + std::max(depth - piece.depth, 0.0f) / piece.sigma_t;
  return t_max_;
}

}  // namespace tyndall
