// SPDX-License-Identifier: Apache-2.0
#include "tyndall/integrators/training_log.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <thread>

#include "tyndall/sampling/random.h"

namespace tyndall {
namespace {

constexpr size_t added = 10'000;

// The sorted keys that are left of `added` samples, from so many threads.
std::vector<uint64_t> kept_keys(TrainingLog& log, size_t threads) {
  std::vector<std::thread> running;
  for (size_t t = 0; t < threads; ++t)
    running.emplace_back([&log, t, threads] {
      for (uint64_t i = t; i < added; i += threads) {
        TrainingSample sample;
        sample.key = hash(i);
        if (log.wants(sample.key)) log.add(sample);
      }
    });
  for (std::thread& thread : running) thread.join();
  std::vector<uint64_t> keys;
  for (const TrainingBuffer& buffer : log.take(1))
    for (const TrainingSample& sample : buffer) keys.push_back(sample.key);
  std::ranges::sort(keys);
  return keys;
}

TEST(TrainingLogTest, KeepsAllThatFit) {
  TrainingLog log(added, added);
  EXPECT_EQ(kept_keys(log, 3).size(), added);
  EXPECT_EQ(log.most_memory(), added * sizeof(TrainingSample));
}

TEST(TrainingLogTest, NeverHoldsMoreThanTheMost) {
  for (const size_t most : {size_t{1}, size_t{100}, size_t{1000}, size_t{5000}}) {
    TrainingLog log(most, most);
    const size_t kept = kept_keys(log, 1).size();
    EXPECT_LE(kept, most);
    EXPECT_GE(kept, most / 3);
    EXPECT_LE(log.most_memory(), most * sizeof(TrainingSample));
    EXPECT_LE(kept_keys(log, 1).size(), most);
  }
  TrainingLog nothing(0, 0);
  EXPECT_TRUE(kept_keys(nothing, 1).empty());
  EXPECT_EQ(nothing.most_memory(), 0u);
}

TEST(TrainingLogTest, ThreadsChangeNothing) {
  TrainingLog one(500, 1000), many(500, 1000);
  for (int pass = 0; pass < 3; ++pass) {
    const std::vector<uint64_t> keys = kept_keys(one, 1);
    EXPECT_FALSE(keys.empty());
    EXPECT_EQ(keys, kept_keys(many, 5));
  }
}

// The second pass is as long as the first.
TEST(TrainingLogTest, KeepsTheUsualNumberOfPassesThatItForesees) {
  TrainingLog log(500, 4000);
  EXPECT_GT(kept_keys(log, 1).size(), 2000u);
  EXPECT_NEAR(static_cast<double>(kept_keys(log, 1).size()), 500, 100);
}

}  // namespace
}  // namespace tyndall
