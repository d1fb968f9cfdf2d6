// SPDX-License-Identifier: Apache-2.0
#include "apps/tyndall/crash_report.h"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>

#include "tyndall/media/volume_in_hand.h"

namespace tyndall::app {
namespace {

TEST(CrashReportDeathTest, NamesTheVolumeThatIsRead) {
  const auto crash = [](int signal) {
    report_crashes_in_volumes();
    const VolumeInHand in_hand("smoke.vdb");
    std::raise(signal);
  };
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGABRT})
    EXPECT_EXIT(crash(signal), testing::ExitedWithCode(2),
                "^error: smoke.vdb: reading it crashed: it is damaged\n$");
}

TEST(CrashReportDeathTest, OtherCrashesEndTheProgramAsBefore) {
  const auto crash = [] {
    report_crashes_in_volumes();
    { const VolumeInHand in_hand("smoke.vdb"); }
    std::abort();
  };
  EXPECT_EXIT(crash(), testing::KilledBySignal(SIGABRT), "^$");
}

TEST(VolumeInHandTest, IsTheInnermost) {
  EXPECT_EQ(volume_in_hand(), nullptr);
  const VolumeInHand outer("a.vdb");
  {
    const VolumeInHand inner("b.vdb");
    EXPECT_STREQ(volume_in_hand(), "b.vdb");
  }
  EXPECT_STREQ(volume_in_hand(), "a.vdb");
}

}  // namespace
}  // namespace tyndall::app
