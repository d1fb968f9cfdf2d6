// SPDX-License-Identifier: Apache-2.0
#include "tyndall/math/parallel_for.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

namespace tyndall {
namespace {

TEST(ParallelForTest, CallsEachIndexOnce) {
  std::vector<int> calls(10'000);
  parallel_for(calls.size(), [&](size_t i) { ++calls[i]; });
  EXPECT_EQ(std::ranges::count(calls, 1), 10'000);
  parallel_for(0, [](size_t) { FAIL(); });
}

TEST(ParallelForTest, ThrowsWhatTheBodyThrows) {
  const auto body = [](size_t i) {
    if (i == 77) throw std::invalid_argument("seventy-seven");
  };
  EXPECT_THROW(parallel_for(100, body), std::invalid_argument);
}

}  // namespace
}  // namespace tyndall
