// SPDX-License-Identifier: Apache-2.0
#include "tyndall/guiding/guiding_file.h"

#include <gtest/gtest.h>

namespace tyndall {
namespace {

std::vector<std::byte> written() {
  VisibilityMapSettings settings;
  settings.resolution = 8;
  settings.lit_outside = true;
  VisibilityMap map(LightView::cone({1, 2, 3}, {0, 0, 1}, 0.9f), settings);
  map.trace_rows(0, 8, [](const Ray& ray, Vec2) { return ray.d.x > 0 ? 2.0f : infinity; });
  map.finish();
  ByteWriter bytes;
  GuidingFileWriter file(bytes);
  file.add_times(8, 2);
  file.add_scene({.lights = 4, .bounds = {{-1, -2, -3}, {1, 2, 3}}, .camera = {0, 5, 0}});
  file.add_map(3, map);
  file.add_records(RecordCache({LightCluster{}}));
  file.finish();
  return bytes.bytes();
}

std::string error_of(std::span<const std::byte> bytes) {
  try {
    read_guiding_file(bytes);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "none";
}

TEST(GuidingFileTest, SurvivesWritingAndReading) {
  const GuidingFile file = read_guiding_file(written());
  EXPECT_EQ(file.seconds, 8);
  EXPECT_EQ(file.training_seconds, 2);
  ASSERT_TRUE(file.scene);
  EXPECT_EQ(file.scene->lights, 4u);
  EXPECT_EQ(file.scene->bounds.max.z, 3);
  EXPECT_EQ(file.scene->camera.y, 5);
  ASSERT_EQ(file.maps.size(), 1u);
  ASSERT_TRUE(file.maps.contains(3));
  const VisibilityMap& map = *file.maps.at(3);
  EXPECT_EQ(map.visibility({1.1f, 2, 4}), 1);
  EXPECT_EQ(map.visibility({1.3f, 2, 6}), map.floor());
  EXPECT_EQ(map.visibility({0.7f, 2, 6}), 1);
  EXPECT_EQ(map.visibility({1, 2, 0}), 1);  // out of the view
  EXPECT_EQ(map.distances(7, 0)[0], 2);
  ASSERT_TRUE(file.records);
  EXPECT_EQ(file.records->clusters().size(), 1u);
}

TEST(GuidingFileTest, SaysWhatIsWrongWithAFile) {
  const std::vector<std::byte> whole = written();
  EXPECT_EQ(error_of({}), "it is no file of --dump-guiding");
  std::vector<std::byte> wrong = whole;
  wrong[0] = std::byte{'X'};
  EXPECT_EQ(error_of(wrong), "it is no file of --dump-guiding");
  wrong = whole;
  wrong[4] = std::byte{9};
  EXPECT_EQ(error_of(wrong), "its format has version 9, this program reads version 3");
  wrong = whole;
  wrong.push_back(std::byte{0});
  EXPECT_EQ(error_of(wrong), "something follows its end");
}

// Between sections too: 8, 36 and the last one's 12 bytes before the end.
TEST(GuidingFileTest, NoPartOfAFileIsAFile) {
  const std::vector<std::byte> whole = written();
  for (size_t size = 4; size < whole.size(); ++size)
    EXPECT_EQ(error_of(std::span(whole).first(size)), "it is cut off") << size;
}

TEST(GuidingFileTest, RefusesDamagedSectionsAndSkipsUnknownOnes) {
  std::vector<std::byte> bytes = written();
  // After magic, version, TIME of 12 + 16 bytes and SCNE of 12 + 64: the name of the map's
  // section.
  constexpr size_t map_section = 8 + 12 + 16 + 12 + 64;
  ASSERT_EQ(bytes[map_section], std::byte{'V'});
  std::vector<std::byte> damaged = bytes;
  damaged[map_section + 12 + 4] = std::byte{77};  // the kind of its view
  EXPECT_EQ(error_of(damaged), "a visibility map in it is damaged");
  bytes[map_section] = std::byte{'?'};
  EXPECT_TRUE(read_guiding_file(bytes).maps.empty());
  EXPECT_TRUE(read_guiding_file(bytes).records);
}

}  // namespace
}  // namespace tyndall
