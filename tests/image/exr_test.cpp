// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <set>

#include "image/temporary_folder.h"
#include "tyndall/image/io.h"
#include "tyndall/image/whole_file.h"

namespace tyndall {
namespace {

// Values with awkward bits: denormal, huge, infinite, minus zero.
Image layered(int width, int height) {
  Image image(width, height);
  int channel = 0;
  for (const char* name :
       {"R", "G", "B", "variance.R", "albedo.G", "normal.X", "depth.Z", "spp.Y"}) {
    std::vector<float>& values = image.channel(name).values;
    ++channel;
    for (size_t i = 0; i < values.size(); ++i) {
      values[i] = static_cast<float>(channel) * std::exp2(static_cast<float>(i % 40) - 20);
    }
    values[0] = std::numeric_limits<float>::infinity();
    values[1] = 1e-42f;
    values[2] = -0.0f;
    values[3] = 1e30f;
  }
  return image;
}

void expect_same_bits(const std::vector<float>& a, const std::vector<float>& b) {
  ASSERT_EQ(a.size(), b.size());
  EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(float)), 0);
}

TEST(ExrTest, FloatKeepsEveryBitOfEveryLayer) {
  const TemporaryFolder folder;
  Image image = layered(37, 19);
  image.find("R")->values[5] = std::numeric_limits<float>::quiet_NaN();
  write_image(image, folder.file("a.exr"));
  const Image back = read_image(folder.file("a.exr"));
  EXPECT_EQ(back.width(), 37);
  EXPECT_EQ(back.height(), 19);
  EXPECT_EQ(back.channels().size(), image.channels().size());
  for (const Channel& channel : image.channels()) {
    ASSERT_TRUE(back.find(channel.name)) << channel.name;
    expect_same_bits(channel.values, back.find(channel.name)->values);
  }
}

TEST(ExrTest, ThreadsWriteTheSameBytes) {
  const TemporaryFolder folder;
  const Image image = layered(300, 200);
  write_image(image, folder.file("one.exr"), {.threads = 1});
  for (const int threads : {0, 2, 7}) {
    write_image(image, folder.file("many.exr"), {.threads = threads});
    EXPECT_EQ(read_whole_file(folder.file("many.exr")),
              read_whole_file(folder.file("one.exr")));
  }
}

TEST(ExrTest, HalfRoundsColourAndKeepsDepthCountAndVariance) {
  const TemporaryFolder folder;
  const Image image = layered(37, 19);
  write_image(image, folder.file("a.exr"), {.half = true});
  const Image back = read_image(folder.file("a.exr"));
  for (const char* name : {"depth.Z", "spp.Y", "variance.R"}) {
    expect_same_bits(image.find(name)->values, back.find(name)->values);
  }
  for (const char* name : {"R", "albedo.G", "normal.X"}) {
    const std::vector<float>& a = image.find(name)->values;
    const std::vector<float>& b = back.find(name)->values;
    EXPECT_EQ(b[3], 65504) << "a finite value became infinite";
    EXPECT_TRUE(std::isinf(b[0]));
    for (size_t i = 40; i < a.size(); ++i) {
      const float value = std::min(a[i], 65504.0f);
      EXPECT_NEAR(b[i], value, std::max(value / 2048, std::exp2(-25.0f)));
    }
  }
}

TEST(ExrTest, KeepsWindowsAndAttributes) {
  const TemporaryFolder folder;
  Image image = layered(8, 4);
  image.offset = {30, 40};
  image.full_size = {100, 80};
  image.text["software"] = "tyndall";
  image.numbers["renderTimeSeconds"] = 1.5f;
  image.numbers["samplesPerPixel"] = 64;
  image.matrices["worldToCamera"].resize(16);
  std::iota(image.matrices["worldToCamera"].begin(), image.matrices["worldToCamera"].end(),
            1.0f);
  write_image(image, folder.file("a.exr"));
  const Image back = read_image(folder.file("a.exr"));
  EXPECT_EQ(back.offset, image.offset);
  EXPECT_EQ(back.full_size, image.full_size);
  EXPECT_EQ(back.text, image.text);
  EXPECT_EQ(back.numbers, image.numbers);
  EXPECT_EQ(back.matrices, image.matrices);
  write_image(back, folder.file("b.exr"));
  EXPECT_EQ(read_whole_file(folder.file("a.exr")), read_whole_file(folder.file("b.exr")));
}

TEST(ExrTest, ReportsAMatrixOfTheWrongSize) {
  const TemporaryFolder folder;
  Image image = layered(8, 4);
  image.matrices["worldToNDC"] = {1, 2, 3};
  const std::string path = folder.file("a.exr");
  EXPECT_EQ(message_of([&] { write_image(image, path); }),
            path + ": cannot write: matrix \"worldToNDC\" is not 4x4");
}

TEST(ExrTest, ReportsTruncatedFiles) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.exr");
  write_image(layered(64, 64), path);
  const std::string bytes = read_whole_file(path);
  write_whole_file(path, bytes.substr(0, bytes.size() - 1000));
  EXPECT_TRUE(message_of([&] { read_image(path); }).starts_with(path + ": cannot read: "));
  write_whole_file(path, bytes.substr(0, 40));
  EXPECT_EQ(message_of([&] { read_image(path); }),
            path + ": cannot read: the file ends too early");
}

// The files below were written by other programs; the expected numbers were read from them
// with the OpenEXR Python package 3.x.
class ForeignExrTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(folder_)) GTEST_SKIP() << folder_ << " is not there";
  }
  Image read(const std::string& name) const { return read_image(folder_ + name); }

  const std::string folder_ = TYNDALL_SOURCE_DIR "/../shared/scenes/data/";
};

double mean_of(const Image& image, const std::string& channel) {
  const std::vector<float>& values = image.find(channel)->values;
  return std::accumulate(values.begin(), values.end(), 0.0) /
         static_cast<double>(values.size());
}

TEST_F(ForeignExrTest, KeepsAllHalfValuesApart) {
  const Image image = read("exr/TestImages_AllHalfValues.exr");
  ASSERT_EQ(image.pixel_count(), 65536u);
  std::set<float> values;
  int not_a_number = 0, infinite = 0;
  for (float v : image.find("G")->values) {
    not_a_number += std::isnan(v);
    infinite += std::isinf(v);
    if (std::isfinite(v)) values.insert(v);
  }
  EXPECT_EQ(not_a_number, 2046);
  EXPECT_EQ(infinite, 2);
  EXPECT_EQ(values.size(), 65536u - 2046 - 2 - 1);  // minus zero equals zero
}

TEST_F(ForeignExrTest, KnowsDisplayWindows) {
  const Image whole = read("exr/DisplayWindow_t01.exr");
  EXPECT_EQ(whole.offset, (Vec2i{0, 0}));
  EXPECT_EQ(whole.full_size, (Vec2i{400, 300}));
  const Image part = read("exr/DisplayWindow_t08.exr");
  EXPECT_EQ(part.width(), 400);
  EXPECT_EQ(part.offset, (Vec2i{30, 40}));
  EXPECT_EQ(part.full_size, (Vec2i{501, 401}));
  EXPECT_EQ(part.find("B")->values, whole.find("B")->values);
  EXPECT_NEAR(mean_of(part, "B"), 0.7400583333, 1e-8);
}

TEST_F(ForeignExrTest, ReadsTheFinestLevelOfTiledFiles) {
  const Image image = read("exr/MultiResolution_ColorCodedLevels.exr");
  EXPECT_EQ(image.width(), 512);
  EXPECT_NEAR(mean_of(image, "R"), 0.4945686473, 1e-8);
  EXPECT_NEAR(image.rgb(170, 256).g, 0.4998f, 1e-4f);
}

TEST_F(ForeignExrTest, TurnsLuminanceAndChromaIntoColour) {
  const Image image = read("exr/Chromaticities_Rec709_YC.exr");
  ASSERT_TRUE(image.has_rgb());
  EXPECT_EQ(image.width(), 610);
  double mean = 0;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) mean += luminance(image.rgb(x, y));
  }
  EXPECT_NEAR(mean / static_cast<double>(image.pixel_count()), 0.2847590704, 2e-3);
  const Rgb left_top = image.rgb(0, 0);  // Y, RY, BY there: 0.3438, -0.1836, -0.672
  EXPECT_NEAR(left_top.r, 0.3438f * (1 - 0.1836f), 3e-3f);
  EXPECT_NEAR(left_top.b, 0.3438f * (1 - 0.672f), 3e-3f);
}

TEST_F(ForeignExrTest, TurnsLuminanceIntoGrey) {
  const Image image = read("exr/TestImages_GrayRampsHorizontal.exr");
  EXPECT_NEAR(mean_of(image, "R"), 0.6429255375, 1e-8);
  EXPECT_EQ(image.find("G")->values, image.find("Y")->values);
}

TEST_F(ForeignExrTest, ReadsTheWholeRangeOfFloat) {
  const Image image = read("exr/TestImages_WideFloatRange.exr");
  EXPECT_FALSE(image.has_rgb());
  EXPECT_EQ(image.find("G")->values[0], -0x1p127f);
}

TEST_F(ForeignExrTest, ReadsEnvironmentMaps) {
  EXPECT_NEAR(mean_of(read("env/ea_courtyard.exr"), "R"), 0.9208753064, 1e-8);
  const Image studio = read("env/studio.exr");  // DWAB
  EXPECT_EQ(studio.width(), 1024);
  EXPECT_NEAR(mean_of(studio, "B"), 0.2786976197, 1e-6);
  EXPECT_NEAR(mean_of(read("env/iset_sky-sunlight.exr"), "A"), 1, 1e-8);
}

}  // namespace
}  // namespace tyndall
