// SPDX-License-Identifier: Apache-2.0
#include "tyndall/guiding/record_cache.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <thread>

#include "guiding/plate.h"
#include "tyndall/math/statistics.h"
#include "tyndall/sampling/random.h"

namespace tyndall {
namespace {

const Vec3 lights[] = {{0, 0, 0}, {3, 3, 3}};

/// The true directional density that the samples below follow: towards a feature near light
/// 0 only; light 1 is three times weaker and shines from one octant.
float arriving(uint32_t cluster, Vec3 p, Vec3 wi) {
  const Vec3 feature = cluster == 0 ? Vec3{0.3f, 0.1f, 0.2f} : Vec3{3, 2.5f, 3};
  const float c = dot(normalize(feature - p), wi);
  return (cluster == 0 ? 3.0f : 1.0f) * (c > 0.8f ? sqr(c - 0.8f) : 0);
}

TrainingSample random_sample(uint64_t key) {
  RandomStream random(key);
  TrainingSample s;
  s.key = key;
  s.p = Vec3{random.next_1d(), random.next_1d(), random.next_1d()} * 2 + Vec3{0.5f, -1, -1};
  s.cluster = random.next_1d() < 0.5f ? 0 : 1;
  s.light_distance = distance(lights[s.cluster], s.p);
  s.light_direction = (lights[s.cluster] - s.p) / s.light_distance;
  const float cos_theta = 2 * random.next_1d() - 1;
  s.wi = spherical_direction(cos_theta, 2 * pi * random.next_1d());
  s.weight = arriving(s.cluster, s.p, s.wi) * 4 * pi;
  s.pdf = s.phase_pdf = inv_4pi;
  s.scatter_distance = 0.2f + random.next_1d();
  s.occluder_distance = random.next_1d() < 0.3f ? 0.5f : infinity;
  s.sigma_t = 0.5f;
  return s;
}

TrainingBuffer random_samples(uint64_t first_key, size_t n) {
  TrainingBuffer buffer;
  for (size_t i = 0; i < n; ++i) buffer.push_back(random_sample(first_key + i));
  return buffer;
}

RecordCacheSettings fast_settings() {
  RecordCacheSettings settings;
  settings.split_samples = 200;
  return settings;
}

RecordCache empty_cache(RecordCacheSettings settings = fast_settings()) {
  return RecordCache(
      {{SquareMeasure::joint_sampling, 1}, {SquareMeasure::joint_sampling, 1}}, settings);
}

void learn(RecordCache& cache, const TrainingBuffer& buffer) { cache.update({&buffer, 1}); }

std::vector<std::byte> bytes_of(const RecordCache& cache) {
  ByteWriter out;
  cache.write(out);
  return out.bytes();
}

TEST(RecordCacheTest, KnowsNothingBeforeTraining) {
  const RecordCache cache = empty_cache();
  EXPECT_EQ(cache.field()->find({0, 0, 0}), nullptr);
  EXPECT_EQ(cache.statistics().records, 1u);
  EXPECT_EQ(cache.statistics().trained_guides, 0u);
}

// The gain that training is for: the second moment of f / p, against the untrained density.
TEST(RecordCacheTest, LearnsWhereTheLightComesFrom) {
  RecordCache cache = empty_cache(RecordCacheSettings{});
  for (uint64_t pass = 0; pass < 4; ++pass)
    learn(cache, random_samples(pass * 1'000'000, 10'000 << pass));
  const auto field = cache.field();
  double learned = 0, untrained = 0;
  for (int i = 0; i < 20'000; ++i) {
    const TrainingSample s = random_sample(77'000'000 + static_cast<uint64_t>(i));
    const GuidingRecord* record = field->find(s.p);
    ASSERT_NE(record, nullptr);
    const DirectionGuide* guide = field->guide(*record, s.cluster);
    ASSERT_NE(guide, nullptr);
    const LightSquare square = guide->square(s.light_direction);
    const float joint = square.density(s.wi);
    const float pdf = guide->share(DirectionTechnique::mixture) * guide->pdf(square, s.wi) +
                      guide->share(DirectionTechnique::joint_sampling) * joint +
                      guide->share(DirectionTechnique::phase) * inv_4pi;
    const float f = arriving(s.cluster, s.p, s.wi);
    learned += static_cast<double>(f * f / pdf);
    untrained += static_cast<double>(f * f / joint);
  }
  // The best mixture of these shares would reach 0.28, the perfect density 0.22.
  EXPECT_LT(learned, 0.37 * untrained);
  EXPECT_GT(cache.statistics().mixture_share, 0.7);
}

TEST(RecordCacheTest, EveryPointNearASampleHasItsRecord) {
  RecordCache cache = empty_cache();
  learn(cache, random_samples(1, 30'000));
  const auto field = cache.field();
  int found = 0;
  EXPECT_GT(field->records().size(), 8u);
  for (uint64_t i = 0; i < 10'000; ++i) {
    const Vec3 p = random_sample(900'000 + i).p;
    const GuidingRecord* record = field->find(p);
    if (!record) continue;
    ++found;
    EXPECT_LE(distance(p, record->center), record->reach * 1.0001f);
    EXPECT_GE(record->reach, record->radius);
  }
  EXPECT_GT(found, 9900);
  // Far from all samples nothing is claimed.
  EXPECT_EQ(field->find({500, 0, 0}), nullptr);
  EXPECT_EQ(field->find({0, -1e30f, 0}), nullptr);
}

TEST(RecordCacheTest, ARecordNeverExceedsItsNeighboursByMoreThanTheirDistance) {
  RecordCache cache = empty_cache();
  // Samples at the left see occluders very near, so the radii differ much.
  TrainingBuffer buffer = random_samples(1, 40'000);
  for (TrainingSample& s : buffer)
    if (s.p.x < 1) s.occluder_distance = 0.01f;
  learn(cache, buffer);
  const auto field = cache.field();
  float least = infinity, most = 0;
  for (const GuidingRecord& r : field->records()) {
    least = std::min(least, r.radius);
    most = std::max(most, r.radius);
  }
  EXPECT_GT(most, 3 * least);
  // Points on both sides of the border between two records.
  for (uint64_t i = 0; i < 5000; ++i) {
    const Vec3 p = random_sample(900'000 + i).p;
    const GuidingRecord* a = field->find(p);
    const GuidingRecord* b = field->find(p + Vec3{0.05f, 0, 0});
    if (!a || !b || a == b) continue;
    EXPECT_LT(a->radius, b->radius + 2 * distance(a->center, b->center) + 1e-4f);
    EXPECT_LT(b->radius, a->radius + 2 * distance(a->center, b->center) + 1e-4f);
  }
}

TEST(RecordCacheTest, BuffersAndTheirOrderDoNotMatter) {
  TrainingBuffer all = random_samples(1, 20'000);
  RecordCache one = empty_cache(), many = empty_cache();
  std::mt19937 shuffle(1);
  for (int pass = 0; pass < 2; ++pass) {
    learn(one, all);
    std::shuffle(all.begin(), all.end(), shuffle);
    std::vector<TrainingBuffer> parts(7);
    for (size_t i = 0; i < all.size(); ++i) parts[(i * i) % 7].push_back(all[i]);
    many.update(parts);
  }
  EXPECT_EQ(bytes_of(one), bytes_of(many));
}

TEST(RecordCacheTest, ThreadsDoNotMatter) {
  const TrainingBuffer all = random_samples(1, 20'000);
  RecordCache one = empty_cache(), many = empty_cache();
  learn(one, all);
  many.update({&all, 1}, [](size_t n, const std::function<void(size_t)>& body) {
    std::vector<std::thread> threads;
    for (size_t t = 0; t < 7; ++t)
      threads.emplace_back([&, t] {
        for (size_t i = n; i-- > 0;)
          if (i % 7 == t) body(i);
      });
    for (std::thread& thread : threads) thread.join();
  });
  EXPECT_EQ(bytes_of(one), bytes_of(many));
}

// A density that changes while a pass reads it would bias the image.
TEST(RecordCacheTest, AHeldFieldNeverChanges) {
  RecordCache cache = empty_cache();
  learn(cache, random_samples(1, 20'000));
  const auto held = cache.field();
  const std::vector<GuidingRecord> records(held->records().begin(), held->records().end());
  const GaussianMixture mixture = held->guides()[0].mixture;
  const DirectionShares shares = held->guides()[0].shares;
  learn(cache, random_samples(50'000, 20'000));
  EXPECT_NE(cache.field(), held);
  EXPECT_EQ(held->guides()[0].mixture, mixture);
  EXPECT_EQ(held->guides()[0].shares, shares);
  ASSERT_EQ(held->records().size(), records.size());
  EXPECT_EQ(held->records()[0].center, records[0].center);
  EXPECT_NE(cache.field()->guides()[0].mixture, mixture);
}

TEST(RecordCacheTest, MemoryStaysWithinItsBound) {
  RecordCacheSettings settings = fast_settings();
  settings.split_samples = 50;
  settings.relative_change = 1e-3;
  settings.memory = 200'000;
  RecordCache cache = empty_cache(settings);
  for (uint64_t pass = 0; pass < 3; ++pass)
    learn(cache, random_samples(pass * 100'000, 20'000));
  EXPECT_LE(cache.memory(), settings.memory);
  EXPECT_GT(cache.memory(), settings.memory / 2);
  EXPECT_LE(cache.field()->memory(), cache.memory());
  EXPECT_GT(cache.statistics().records, 20u);
}

TEST(RecordCacheTest, RecordsAreNoWiderThanTheirValidityWhereSamplesAreMany) {
  RecordCacheSettings settings = fast_settings();
  settings.split_samples = 10;
  RecordCache cache = empty_cache(settings);
  learn(cache, random_samples(1, 50'000));
  RunningMoments ratio;
  for (const GuidingRecord& r : cache.field()->records()) ratio.add(r.reach / r.radius);
  EXPECT_LT(ratio.mean(), 3);
}

TEST(RecordCacheTest, BadSamplesAreCountedAndLeftOut) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  TrainingBuffer good = random_samples(1, 5000), bad = good;
  const auto spoil = [&](auto change) {
    TrainingSample s = good[0];
    s.key += 1'000'000 + bad.size();
    change(s);
    bad.push_back(s);
  };
  spoil([&](TrainingSample& s) { s.weight = nan; });
  spoil([&](TrainingSample& s) { s.weight = -1; });
  spoil([&](TrainingSample& s) { s.weight = infinity; });
  spoil([&](TrainingSample& s) { s.p.y = nan; });
  spoil([&](TrainingSample& s) { s.wi = {}; });
  spoil([&](TrainingSample& s) { s.light_direction = {nan, 0, 0}; });
  spoil([&](TrainingSample& s) { s.light_distance = 0; });
  spoil([&](TrainingSample& s) { s.cluster = 2; });
  spoil([&](TrainingSample& s) { s.phase_pdf = nan; });
  spoil([&](TrainingSample& s) { s.sigma_t = infinity; });
  spoil([&](TrainingSample& s) { s.pdf = 0; });
  RecordCache clean = empty_cache(), spoilt = empty_cache();
  learn(clean, good);
  learn(spoilt, bad);
  EXPECT_EQ(spoilt.statistics().rejected, 11u);
  EXPECT_EQ(spoilt.field()->records().size(), clean.field()->records().size());
  EXPECT_EQ(spoilt.field()->guides()[0].mixture, clean.field()->guides()[0].mixture);
}

/// Everything that a reader may meet is finite and usable.
void expect_sane(const RecordCache& cache, const TrainingBuffer& where) {
  const auto field = cache.field();
  for (const TrainingSample& s : where) {
    const GuidingRecord* record = field->find(s.p);
    if (!record) continue;
    float total = 0;
    for (uint32_t k = 0; k < field->clusters(); ++k)
      total += field->cluster_probability(*record, k);
    ASSERT_NEAR(total, 1, 1e-4);
    const DirectionGuide* guide = field->guide(*record, s.cluster);
    if (!guide) continue;
    const float pdf = guide->pdf(guide->square(s.light_direction), s.wi);
    ASSERT_TRUE(std::isfinite(pdf) && pdf >= 0);
    ASSERT_NEAR(guide->shares[0] + guide->shares[1] + guide->shares[2], 1, 1e-5);
    ASSERT_GE(*std::min_element(guide->shares.begin(), guide->shares.end()), 0.099f);
  }
}

TEST(RecordCacheTest, DegenerateInputsAreHarmless) {
  TrainingBuffer dark = random_samples(1, 5000), same(5000, random_sample(3)), huge, spiky;
  for (TrainingSample& s : dark) s.weight = 0;
  same[0].weight = 2;
  for (size_t i = 0; i < same.size(); ++i) same[i].key = i, same[i].weight = 1;
  for (TrainingSample s : random_samples(1, 5000)) {
    s.p *= 1e6f;
    s.weight *= 1e30f;
    s.light_distance = infinity;
    huge.push_back(s);
    s = random_sample(s.key);
    s.weight = s.key % 1000 == 0 ? 1e38f : 1e-38f;
    spiky.push_back(s);
  }
  for (const TrainingBuffer& buffer : {dark, same, huge, spiky, TrainingBuffer{}}) {
    RecordCache cache = empty_cache();
    for (int pass = 0; pass < 3; ++pass) learn(cache, buffer);
    expect_sane(cache, buffer);
    EXPECT_EQ(cache.statistics().rejected, 0u);
  }
  RecordCache no_lights({});
  learn(no_lights, random_samples(1, 100));
  EXPECT_EQ(no_lights.statistics().rejected, 100u);
  EXPECT_EQ(no_lights.field()->find({1, 0, 0}), nullptr);
}

TEST(RecordCacheTest, ClustersAreChosenByWhatTheyContribute) {
  RecordCacheSettings settings = fast_settings();
  settings.split_samples = 1e9;  // one record
  RecordCache cache = empty_cache(settings);
  const TrainingBuffer samples = random_samples(1, 40'000);
  learn(cache, samples);
  double squares[2] = {0, 0}, counts[2] = {0, 0};
  for (const TrainingSample& s : samples) {
    squares[s.cluster] += static_cast<double>(s.weight) * static_cast<double>(s.weight);
    ++counts[s.cluster];
  }
  const double a = std::sqrt(squares[0] / counts[0]), b = std::sqrt(squares[1] / counts[1]);
  const auto field = cache.field();
  const GuidingRecord& record = field->records()[0];
  EXPECT_NEAR(field->cluster_probability(record, 0), 0.1 + 0.8 * a / (a + b), 1e-4);
  EXPECT_NEAR(field->cluster_probability(record, 1), 0.1 + 0.8 * b / (a + b), 1e-4);
}

TEST(RecordCacheTest, UnsampledClustersKeepTheirChance) {
  RecordCache cache({{SquareMeasure::joint_sampling, 3}, {SquareMeasure::solid_angle, 1}});
  TrainingBuffer samples;
  for (const TrainingSample& s : random_samples(1, 5000))
    if (s.cluster == 0) samples.push_back(s);
  learn(cache, samples);
  const auto field = cache.field();
  EXPECT_NEAR(field->cluster_probability(field->records()[0], 1), 0.25f, 1e-4f);
  EXPECT_EQ(field->guide(field->records()[0], 1), nullptr);
}

TEST(RecordCacheTest, FewerGuidesThanClustersGoToTheBrightest) {
  RecordCacheSettings settings = fast_settings();
  settings.guides_per_record = 1;
  settings.split_samples = 1e9;
  RecordCache cache = empty_cache(settings);
  learn(cache, random_samples(1, 5000));
  const auto field = cache.field();
  EXPECT_NE(field->guide(field->records()[0], 0), nullptr);
  EXPECT_EQ(field->guide(field->records()[0], 1), nullptr);
}

TEST(RecordCacheTest, SurvivesWritingAndReading) {
  RecordCache cache = empty_cache();
  learn(cache, random_samples(1, 20'000));
  const std::vector<std::byte> bytes = bytes_of(cache);
  RecordCache copy = empty_cache();
  ByteReader in(bytes);
  ASSERT_TRUE(copy.read(in));
  EXPECT_EQ(in.remaining(), 0u);
  EXPECT_EQ(bytes_of(copy), bytes);
  EXPECT_EQ(copy.statistics().guides, cache.statistics().guides);
  ByteReader again(bytes);
  const std::optional<RecordCache> loaded = RecordCache::load(again);
  ASSERT_TRUE(loaded);
  EXPECT_EQ(bytes_of(*loaded), bytes);
  // Both learn on alike.
  const TrainingBuffer more = random_samples(70'000, 5000);
  learn(cache, more);
  learn(copy, more);
  EXPECT_EQ(bytes_of(copy), bytes_of(cache));
}

TEST(RecordCacheTest, DamagedFilesAreRefused) {
  RecordCache cache = empty_cache();
  learn(cache, random_samples(1, 3000));
  const std::vector<std::byte> bytes = bytes_of(cache), before = bytes_of(empty_cache());
  for (size_t size = 0; size < bytes.size(); size += 1 + bytes.size() / 200) {
    RecordCache copy = empty_cache();
    ByteReader in(std::span<const std::byte>(bytes).first(size));
    EXPECT_FALSE(copy.read(in)) << size;
    EXPECT_EQ(bytes_of(copy), before);
  }
  RandomStream random(1);
  for (int i = 0; i < 300; ++i) {  // any damage: refused or harmless, never a crash
    std::vector<std::byte> damaged = bytes;
    for (int k = 0; k < 4; ++k)
      damaged[random.next_bits() % 200] = static_cast<std::byte>(random.next_bits());
    RecordCache copy = empty_cache();
    ByteReader in(damaged);
    if (copy.read(in)) copy.field()->find({1, 0, 0});
    ByteReader again(damaged);
    if (const auto loaded = RecordCache::load(again)) loaded->field()->find({1, 0, 0});
  }
  RecordCache other({{SquareMeasure::joint_sampling, 1}});
  ByteReader in(bytes);
  EXPECT_FALSE(other.read(in));
}

TEST(ValidityRadiusTest, FollowsTheGradientOfDoubleScattering) {
  EXPECT_FLOAT_EQ(validity_radius(0.5, 1 / 4.0, 0, 0, 0), 2);     // eps D
  EXPECT_FLOAT_EQ(validity_radius(0.5, 1 / 4.0, 0.25, 0, 0), 1);  // eps / (1/D + sigma_t)
  EXPECT_FLOAT_EQ(validity_radius(0.5, 0.25, 0, 0.25, 0), 1);     // an occluder at D
  EXPECT_FLOAT_EQ(validity_radius(0.5, 0.25, 0, 0, std::sqrt(3.0)), 1);  // anisotropic
  EXPECT_EQ(validity_radius(0.5, 0, 0, 0, 0), infinity);
}

}  // namespace
}  // namespace tyndall
