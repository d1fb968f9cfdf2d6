// SPDX-License-Identifier: Apache-2.0
#include "tyndall/image/whole_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>

#include "image/temporary_folder.h"

namespace tyndall {
namespace {

TEST(WholeFileTest, ReadsWhatItWrote) {
  const TemporaryFolder folder;
  std::string bytes(300000, 'a');
  bytes[7] = '\0';
  write_whole_file(folder.file("a"), "older");
  write_whole_file(folder.file("a"), bytes);
  EXPECT_EQ(read_whole_file(folder.file("a")), bytes);
  EXPECT_EQ(folder.file_count(), 1u);
}

TEST(WholeFileTest, ReportsPathAndReason) {
  const TemporaryFolder folder;
  const std::string missing = folder.file("missing/a");
  EXPECT_EQ(message_of([&] { read_whole_file(missing); }),
            missing + ": cannot read: No such file or directory");
  EXPECT_EQ(message_of([&] { write_whole_file(missing, "x"); }),
            missing + ": cannot write: No such file or directory");
  EXPECT_EQ(message_of([&] { check_can_write_file(missing); }),
            missing + ": cannot write: No such file or directory");
  const std::string folder_path = folder.file("");
  EXPECT_EQ(message_of([&] { write_whole_file(folder_path, "x"); }),
            folder_path + ": cannot write: Is a directory");
  EXPECT_EQ(message_of([&] { read_whole_file(folder_path); }),
            folder_path + ": cannot read: Is a directory");
}

TEST(WholeFileTest, CheckLeavesNothingBehind) {
  const TemporaryFolder folder;
  check_can_write_file(folder.file("a"));
  EXPECT_EQ(folder.file_count(), 0u);
  write_whole_file(folder.file("a"), "kept");
  check_can_write_file(folder.file("a"));
  EXPECT_EQ(read_whole_file(folder.file("a")), "kept");
}

TEST(WholeFileTest, WritesThroughLinks) {
  namespace fs = std::filesystem;
  const TemporaryFolder folder;
  fs::create_directory(folder.file("there"));
  fs::create_symlink("there/b", folder.file("a"));  // leads to nothing yet
  fs::create_symlink(folder.file("a"), folder.file("there/c"));
  for (const std::string bytes : {"first", "second"}) {
    const std::string link = folder.file("there/c");
    check_can_write_file(link);
    write_whole_file(link, bytes);
    EXPECT_TRUE(fs::is_symlink(link) && fs::is_symlink(folder.file("a")));
    EXPECT_FALSE(fs::is_symlink(folder.file("there/b")));
    EXPECT_EQ(read_whole_file(folder.file("there/b")), bytes);
  }
  EXPECT_EQ(folder.file_count(), 2u);
}

TEST(WholeFileTest, RefusesLinksInACircle) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a");
  std::filesystem::create_symlink("a", path);
  const std::string expected = path + ": cannot write: Too many levels of symbolic links";
  EXPECT_EQ(message_of([&] { write_whole_file(path, "x"); }), expected);
  EXPECT_EQ(message_of([&] { check_can_write_file(path); }), expected);
}

TEST(WholeFileTest, WritesIntoPipes) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a");
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
  const int reader = ::open(path.c_str(), O_RDWR | O_NONBLOCK);
  check_can_write_file(path);
  write_whole_file(path, "x");
  char byte = '\0';
  EXPECT_EQ(::read(reader, &byte, 1), 1);
  EXPECT_EQ(byte, 'x');
  ::close(reader);
  EXPECT_EQ(folder.file_count(), 1u);
}

TEST(WholeFileTest, ReportsMissingPermission) {
  if (::geteuid() == 0) GTEST_SKIP() << "the superuser may write everywhere";
  const TemporaryFolder folder;
  const std::string locked = folder.file("locked");
  std::filesystem::create_directory(locked);
  std::filesystem::permissions(locked, std::filesystem::perms::owner_read);
  EXPECT_EQ(message_of([&] { check_can_write_file(locked + "/a"); }),
            locked + "/a: cannot write: Permission denied");
}

TEST(WholeFileTest, AFailedWriteKeepsTheOlderFile) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a");
  write_whole_file(path, "older");
  struct rlimit before;
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const struct rlimit small = {1000, before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  const std::string message =
      message_of([&] { write_whole_file(path, std::string(5000, 'x')); });
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(message, path + ": cannot write: File too large");
  EXPECT_EQ(read_whole_file(path), "older");
  EXPECT_EQ(folder.file_count(), 1u);
}

}  // namespace
}  // namespace tyndall
