// SPDX-License-Identifier: Apache-2.0
// How much a learned direction gains for double scattering behind a plate with one hole:
// the study of section H of the design's literature notes, made with the library. A point b
// at the origin of an isotropic medium, a light at distance one, a plate between them.
// Prints the relative variance of one (direction, equi-angular distance) sample of the
// light that reaches b after one scattering event, untrained (Georgiev's density) and
// trained, over four seeds.

#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "tyndall/guiding/record_cache.h"
#include "tyndall/math/statistics.h"
#include "tyndall/sampling/random.h"

namespace tyndall {
namespace {

constexpr float sigma_t = 0.5f;
constexpr Vec3 light{0, 0, 1};

struct Scene {
  const char* name;
  float hole_x, hole_radius, plate_z;
  float extinction = sigma_t;

  bool is_blocked(Vec3 from, Vec3 to) const {
    if ((from.z < plate_z) == (to.z < plate_z)) return false;
    const Vec3 p = lerp(from, to, (plate_z - from.z) / (to.z - from.z));
    return sqr(p.x - hole_x) + sqr(p.y) > sqr(hole_radius);
  }

  /// One sample of the radiance that arrives at the origin from direction w, the distance
  /// drawn equi-angularly about the light; zero if blocked.
  float radiance(Vec3 w, float u, float& distance) const {
    const float along = dot(light, w), off = std::max(length(light - w * along), 1e-6f);
    const float start = std::atan(-along / off);
    const float angle = start + u * (0.5f * pi - start);
    distance = along + off * std::tan(angle);
    const Vec3 c = w * distance;
    if (!(distance > 0 && distance < 1e6f) || is_blocked({}, c) || is_blocked(c, light))
      return 0;
    // 1 / |c - light|^2 cancels against the density of the distance but for these factors.
    const float to_light = length(light - c);
    return std::exp(-extinction * (distance + to_light)) * (0.5f * pi - start) / off;
  }
};

/// The density of directions that a render would use: the guide's shares of its techniques.
struct Proposal {
  LightSquare square;
  const DirectionGuide* guide;  // null: joint sampling alone
  DirectionShares shares{0, 1, 0};

  Vec3 sample(RandomStream& random) const {
    const float technique = random.next_1d();
    const Vec2 u = random.next_2d();
    if (technique < shares[0]) {
      const auto s = guide->sample(square, u);
      return s ? s->w : Vec3{};
    }
    if (technique < shares[0] + shares[1]) return square.direction(u).w;
    return spherical_direction(1 - 2 * u.x, 2 * pi * u.y);
  }
  float pdf(Vec3 w) const {
    const float mixture = guide ? guide->pdf(square, w) : 0;
    return shares[0] * mixture + shares[1] * square.density(w) + shares[2] * inv_4pi;
  }
};

double relative_variance(const Scene& scene, const Proposal& proposal, int n) {
  RunningMoments moments;
  RandomStream random(12345);
  for (int i = 0; i < n; ++i) {
    const Vec3 w = proposal.sample(random);
    float distance;
    const bool is_empty = length_squared(w) == 0;
    moments.add(is_empty ? 0
                         : scene.radiance(w, random.next_1d(), distance) / proposal.pdf(w));
  }
  return moments.variance() / (moments.mean() * moments.mean());
}

/// Training in four passes; a third of the directions is uniform, to explore.
RecordCache train(const Scene& scene, int samples, uint64_t seed,
                  const RecordCacheSettings& settings) {
  RecordCache cache({LightCluster{}}, settings);
  const LightSquare square(Frame::from_z(light), SquareMeasure::joint_sampling);
  RandomStream random(seed);
  uint64_t key = 0;
  for (int pass = 0; pass < 4; ++pass) {
    const auto field = cache.field();
    const GuidingRecord* record = field->find({});
    const DirectionGuide* guide = record ? field->guide(*record, 0) : nullptr;
    Proposal proposal{guide ? guide->square(light) : square, guide};
    proposal.shares = guide ? DirectionShares{1 / 3.0f, 1 / 3.0f, 1 / 3.0f}
                            : DirectionShares{0, 2 / 3.0f, 1 / 3.0f};
    TrainingBuffer buffer;
    for (int i = 0; i < samples / 4; ++i) {
      TrainingSample s;
      s.key = ++key;
      s.light_direction = light;
      s.wi = proposal.sample(random);
      const float u = random.next_1d();
      if (length_squared(s.wi) == 0) continue;
      s.pdf = proposal.pdf(s.wi);
      s.weight = scene.radiance(s.wi, u, s.scatter_distance) / s.pdf;
      s.phase_pdf = inv_4pi;
      s.light_distance = 1;
      buffer.push_back(s);
    }
    cache.update({&buffer, 1});
  }
  return cache;
}

void report(const Scene& scene, int samples, const RecordCacheSettings& settings) {
  const int n = 400'000;
  const LightSquare square(Frame::from_z(light), SquareMeasure::joint_sampling);
  std::printf("%-34s %6d  %8.2f  ", scene.name, samples,
              relative_variance(scene, {square, nullptr}, n));
  std::string learned, halves;
  for (uint64_t seed = 1; seed <= 4; ++seed) {
    const RecordCache cache = train(scene, samples, seed, settings);
    const auto field = cache.field();
    const DirectionGuide& guide = field->guides()[0];
    Proposal proposal{guide.square(light), &guide, guide.shares};
    char text[64];
    std::snprintf(text, sizeof text, " %7.2f", relative_variance(scene, proposal, n));
    learned += text;
    proposal.shares = {0.5f, 0.5f, 0};
    std::snprintf(text, sizeof text, " %7.2f", relative_variance(scene, proposal, n));
    halves += text;
  }
  std::printf("%s  |%s\n", halves.c_str(), learned.c_str());
}

}  // namespace
}  // namespace tyndall

int main() {
  using namespace tyndall;
  const Scene scenes[] = {
      {"no occluder, sigma_t 2", 0, 1e6f, 0.5f, 2},
      {"hole r .2 at x .15 (all lit)", 0.15f, 0.2f, 0.5f},
      {"hole r .15 at x .5 (5 % lit)", 0.5f, 0.15f, 0.3f},
      {"hole r .3 at x 1.5 (2 % lit)", 1.5f, 0.3f, 0.5f},
  };
  std::printf("%-34s %6s  %8s    half mixture, half joint; 4 seeds | learned shares\n",
              "scene", "train", "joint");
  for (const int samples : {8000, 32'000})
    for (const Scene& scene : scenes) {
      RecordCacheSettings settings;
      settings.split_samples = 1e9;
      report(scene, samples, settings);
    }
}
