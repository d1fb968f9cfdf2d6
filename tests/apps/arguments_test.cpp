// SPDX-License-Identifier: Apache-2.0
#include "apps/tyndall/arguments.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "apps/tyndall/nearest_name.h"
#include "apps/tyndall/parse_values.h"
#include "apps/tyndall/shell_line.h"

namespace tyndall::app {
namespace {

/// A program with one subcommand, its values, and what it wrote to stderr and stdout.
class ArgumentsTest : public testing::Test {
 protected:
  ExitCode run(std::vector<const char*> words) {
    Program program("prog", "A program.", "prog 1.2.3");
    Command command = program.add_command("work", "Do work");
    command.positional("INPUT", &input, "what to work on", {.required = true})
        .option("--spp", &spp, "samples")
        .option("-o,--output", &outputs, "files")
        .option("--level", &level, "how much", {.choices = {"low", "high"}})
        .option(
            "--time-limit",
            [this](const std::string& text) { time = parse_duration(text); }, "limit")
        .flag("--fast", &fast, "hurry")
        .on_run([this] {
          ran = true;
          return ExitCode::stopped;
        });
    words.insert(words.begin(), "prog");
    testing::internal::CaptureStderr();
    testing::internal::CaptureStdout();
    const ExitCode code = program.run(static_cast<int>(words.size()), words.data());
    out = testing::internal::GetCapturedStdout();
    err = testing::internal::GetCapturedStderr();
    return code;
  }

  void TearDown() override {
    unsetenv("TYNDALL_SPP");
    unsetenv("TYNDALL_TIME_LIMIT");
    unsetenv("TYNDALL_FAST");
  }

  std::string input, out, err, level = "low";
  std::optional<uint32_t> spp;
  std::vector<std::string> outputs;
  double time = 0;
  bool fast = false, ran = false;
};

TEST_F(ArgumentsTest, RunsTheSubcommand) {
  EXPECT_EQ(
      run({"work", "-o", "a", "--spp", "4", "in", "-o", "b", "--fast", "--level=high"}),
      ExitCode::stopped);
  EXPECT_TRUE(ran && fast);
  EXPECT_EQ(input, "in");
  EXPECT_EQ(spp, 4u);
  EXPECT_EQ(outputs, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(level, "high");
}

TEST_F(ArgumentsTest, LastOneWins) {
  EXPECT_EQ(run({"work", "in", "--spp", "4", "--spp", "8"}), ExitCode::stopped);
  EXPECT_EQ(spp, 8u);
}

TEST_F(ArgumentsTest, EnvironmentIsOverriddenByTheCommandLine) {
  setenv("TYNDALL_SPP", "16", 1);
  setenv("TYNDALL_TIME_LIMIT", "2m", 1);
  setenv("TYNDALL_FAST", "1", 1);
  EXPECT_EQ(run({"work", "in"}), ExitCode::stopped);
  EXPECT_EQ(spp, 16u);
  EXPECT_EQ(time, 120);
  EXPECT_TRUE(fast);
  EXPECT_EQ(run({"work", "in", "--spp", "4"}), ExitCode::stopped);
  EXPECT_EQ(spp, 4u);
}

TEST_F(ArgumentsTest, BlamesTheEnvironmentWhereItIsWrong) {
  setenv("TYNDALL_TIME_LIMIT", "soon", 1);
  EXPECT_EQ(run({"work", "in"}), ExitCode::usage);
  EXPECT_EQ(
      err,
      "error: TYNDALL_TIME_LIMIT: must be a positive time such as 30s, 10m or 1h30m, got "
      "'soon'\nSee 'prog work --help'.\n");
  EXPECT_FALSE(ran);
}

TEST_F(ArgumentsTest, SaysWhatIsWrong) {
  const std::string see = "\nSee 'prog work --help'.\n";
  EXPECT_EQ(run({"work"}), ExitCode::usage);
  EXPECT_EQ(err, "error: INPUT is required" + see);
  EXPECT_EQ(run({"work", "in", "--spp", "many"}), ExitCode::usage);
  EXPECT_EQ(err,
            "error: --spp: must be a whole number from 0 to 4294967295, got 'many'" + see);
  EXPECT_EQ(run({"work", "in", "--level", "medium"}), ExitCode::usage);
  EXPECT_EQ(err, "error: --level: must be one of low, high, got 'medium'" + see);
  EXPECT_EQ(run({"work", "in", "--ssp=4"}), ExitCode::usage);
  EXPECT_EQ(err, "error: unknown argument '--ssp=4'; did you mean --spp?" + see);
  EXPECT_EQ(run({"work", "in", "more"}), ExitCode::usage);
  EXPECT_EQ(err, "error: unknown argument 'more'" + see);
  EXPECT_EQ(run({"work", "in", "--spp"}), ExitCode::usage);
  EXPECT_EQ(err, "error: --spp requires a value" + see);
  EXPECT_FALSE(ran);
}

TEST_F(ArgumentsTest, NamesTheNearestCommand) {
  EXPECT_EQ(run({"wrok", "in"}), ExitCode::usage);
  EXPECT_EQ(err, "error: unknown command 'wrok'; did you mean work?\nSee 'prog --help'.\n");
  EXPECT_EQ(run({}), ExitCode::usage);
  EXPECT_EQ(err, "error: a command is required\nSee 'prog --help'.\n");
}

TEST_F(ArgumentsTest, HelpAndVersionGoToStdout) {
  EXPECT_EQ(run({"--version"}), ExitCode::done);
  EXPECT_EQ(out, "prog 1.2.3\n");
  EXPECT_EQ(run({"work", "--help"}), ExitCode::done);
  EXPECT_NE(out.find("--level low|high"), std::string::npos) << out;
  EXPECT_EQ(err, "");
  EXPECT_FALSE(ran);
}

TEST(NearestName, IsNearOrNothing) {
  EXPECT_EQ(nearest_name("--outptu", {"--output", "--orders"}), "--output");
  EXPECT_EQ(nearest_name("--banana", {"--output", "--orders"}), "");
  EXPECT_EQ(nearest_name("", {}), "");
}

TEST(ShellLine, QuotesWhatAShellWouldSplit) {
  const char* words[] = {"a", "b c", "it's", "", "--x=1,2"};
  EXPECT_EQ(shell_line(5, words), R"(a 'b c' 'it'\''s' '' --x=1,2)");
}

}  // namespace
}  // namespace tyndall::app
