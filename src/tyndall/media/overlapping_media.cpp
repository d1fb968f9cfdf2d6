// SPDX-License-Identifier: Apache-2.0
#include "tyndall/media/overlapping_media.h"

namespace tyndall {
namespace {

MediumProperties properties(const SingleMedium& medium, Vec3 p) {
  return std::visit([&](const auto& m) -> MediumProperties { return m.at(p); }, medium);
}

const PhaseFunction& phase_of(const SingleMedium& medium) {
  return std::visit([](const auto& m) -> const PhaseFunction& { return m.phase(); },
                    medium);
}

// Adds media up; emission in proportion to what emits it.
class Sum {
 public:
  void add(const MediumProperties& part) {
    total_.sigma_a += part.sigma_a;
    total_.sigma_s += part.sigma_s;
    emitted_ += part.sigma_a * part.Le;
  }
  MediumProperties total() const {
    return {total_.sigma_a, total_.sigma_s, safe_divide(emitted_, total_.sigma_a)};
  }

 private:
  MediumProperties total_{};
  Rgb emitted_;
};

}  // namespace

OverlappingMedia::Segments::Segments(const OverlappingMedia& media, const Ray& ray,
                                     float t_max) {
  for (const SingleMedium& medium : media.parts_)
    std::visit(
        [&](const auto& m) {
          parts_.push_back({.walk = Walk(m.segments(ray, t_max)),
                            .segment = {},
                            .has_segment = false,
                            .meets_anything = false,
                            .is_active = false});
        },
        medium);
  for (Part& part : parts_)
    part.has_segment = part.meets_anything =
        std::visit([&](auto& walk) { return walk.next(part.segment); }, part.walk);
}

bool OverlappingMedia::Segments::next(MediumSegment& segment) {
  for (;;) {
    float end = infinity, begin = infinity;
    bool any = false;
    segment.majorant = segment.mean = Rgb(0);
    for (Part& part : parts_) {
      // What ends here makes room for its next segment.
      while (part.has_segment && !(part.segment.t_max > t_))
        part.has_segment =
            std::visit([&](auto& walk) { return walk.next(part.segment); }, part.walk);
      part.is_active = part.has_segment && !(part.segment.t_min > t_);
      if (!part.has_segment) continue;
      if (part.is_active) {
        any = true;
        end = std::min(end, part.segment.t_max);
        segment.majorant += part.segment.majorant;
        segment.mean += part.segment.mean;
      } else {
        begin = std::min(begin, part.segment.t_min);
      }
    }
    if (!any && begin == infinity) return false;
    segment.t_min = t_;
    t_ = segment.t_max = any ? std::min(end, begin) : begin;
    if (any) return true;
  }
}

MediumProperties OverlappingMedia::Segments::at(float t) const {
  Sum sum;
  for (const Part& part : parts_)
    if (part.is_active)
      sum.add(std::visit([&](const auto& w) -> MediumProperties { return w.at(t); },
                         part.walk));
  return sum.total();
}

Rgb OverlappingMedia::Segments::sigma_t(float t) const {
  Rgb sum;
  for (const Part& part : parts_)
    if (part.is_active)
      sum += std::visit([&](const auto& w) { return w.sigma_t(t); }, part.walk);
  return sum;
}

Rgb OverlappingMedia::Segments::sigma_t_anywhere(float t) const {
  Rgb sum;
  for (const Part& part : parts_)
    if (part.meets_anything)
      sum += std::visit([&](const auto& w) { return w.sigma_t_anywhere(t); }, part.walk);
  return sum;
}

MediumProperties OverlappingMedia::at(Vec3 p) const {
  Sum sum;
  for (const SingleMedium& part : parts_) sum.add(properties(part, p));
  return sum.total();
}

bool OverlappingMedia::is_emissive() const {
  return std::ranges::any_of(parts_, [](const SingleMedium& part) {
    return std::visit([](const auto& m) { return m.is_emissive(); }, part);
  });
}

bool OverlappingMedia::is_grey() const {
  return std::ranges::all_of(parts_, [](const SingleMedium& part) {
    return std::visit([](const auto& m) { return m.is_grey(); }, part);
  });
}

const PhaseFunction& OverlappingMedia::phase() const { return phase_of(parts_.front()); }

Rgb OverlappingMedia::eval_phase(Vec3 p, Vec3 wo, Vec3 wi) const {
  Rgb sum, sigma_s;
  for (const SingleMedium& part : parts_) {
    const Rgb of_part = properties(part, p).sigma_s;
    sigma_s += of_part;
    sum += of_part * phase_of(part).eval(wo, wi);
  }
  return safe_divide(sum, sigma_s);
}

float OverlappingMedia::pdf_phase(Vec3 p, Vec3 wo, Vec3 wi) const {
  float sum = 0, sigma_s = 0;
  for (const SingleMedium& part : parts_) {
    const float of_part = average(properties(part, p).sigma_s);
    sigma_s += of_part;
    sum += of_part * phase_of(part).pdf(wo, wi);
  }
  return sigma_s > 0 ? sum / sigma_s : 0;
}

std::optional<MediumDirection> OverlappingMedia::sample_phase(Vec3 p, Vec3 wo,
                                                              Vec2 u) const {
  boost::container::small_vector<float, 4> cumulative;
  float sum = 0;
  for (const SingleMedium& part : parts_)
    cumulative.push_back(sum += average(properties(part, p).sigma_s));
  if (!(sum > 0)) return std::nullopt;
  size_t i = 0;
  while (i + 1 < parts_.size() && !(u.x * sum < cumulative[i])) ++i;
  const float below = i > 0 ? cumulative[i - 1] : 0;
  u.x = std::clamp((u.x * sum - below) / (cumulative[i] - below), 0.0f, one_minus_epsilon);
  const std::optional<PhaseSample> s = phase_of(parts_[i]).sample(wo, u);
  if (!s) return std::nullopt;
  return MediumDirection{s->wi, eval_phase(p, wo, s->wi), pdf_phase(p, wo, s->wi)};
}

}  // namespace tyndall
