// SPDX-License-Identifier: Apache-2.0
#include "tyndall/loader/ply.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <string>

#include "tyndall/loader/files.h"

namespace tyndall::loader {
namespace {

const std::string triangle_header =
    "element vertex 3\nproperty double x\nproperty float y\nproperty short z\n"
    "element face 1\nproperty uchar color\nproperty list uchar uint "
    "vertex_index\nend_header\n";

template <typename T>
void append(std::string& bytes, T value, bool is_big_endian) {
  std::string raw(sizeof(T), '\0');
  std::memcpy(raw.data(), &value, sizeof(T));
  if (is_big_endian) std::reverse(raw.begin(), raw.end());
  bytes += raw;
}

std::string binary_triangle(bool is_big_endian) {
  std::string bytes = std::string("ply\nformat ") +
                      (is_big_endian ? "binary_big_endian" : "binary_little_endian") +
                      " 1.0\n" + triangle_header;
  for (const auto& [x, y, z] :
       {std::tuple{0.5, 1.5f, -2}, {1e10, 0.0f, 3}, {-1.0, 2.0f, 300}}) {
    append(bytes, x, is_big_endian);
    append(bytes, y, is_big_endian);
    append(bytes, static_cast<int16_t>(z), is_big_endian);
  }
  append(bytes, uint8_t{200}, is_big_endian);
  append(bytes, uint8_t{3}, is_big_endian);
  for (const uint32_t index : {2u, 1u, 0u}) append(bytes, index, is_big_endian);
  return bytes;
}

void expect_triangle(const PlyMesh& mesh) {
  EXPECT_EQ(mesh.positions,
            (std::vector<Vec3>{{0.5f, 1.5f, -2}, {1e10f, 0, 3}, {-1, 2, 300}}));
  EXPECT_EQ(mesh.triangles, (std::vector<Vec3i>{{2, 1, 0}}));
  EXPECT_TRUE(mesh.normals.empty());
  EXPECT_TRUE(mesh.uvs.empty());
}

TEST(PlyTest, ReadsAscii) {
  expect_triangle(read_ply("ply\r\nformat ascii 1.0\r\ncomment by hand\r\n" +
                           triangle_header + "0.5 1.5 -2\n1e10 0 3 -1 2 300\n200 3 2 1 0"));
}

TEST(PlyTest, ReadsBinaryOfBothByteOrders) {
  expect_triangle(read_ply(binary_triangle(false)));
  expect_triangle(read_ply(binary_triangle(true)));
}

TEST(PlyTest, RefusesEveryTruncation) {
  const std::string bytes = binary_triangle(false);
  for (size_t size = 0; size < bytes.size(); ++size)
    EXPECT_THROW(read_ply(std::string_view(bytes).substr(0, size)), std::runtime_error)
        << size;
}

TEST(PlyTest, ReadsNormalsAndTextureCoordinates) {
  for (const auto& [u, v] : {std::pair{"u", "v"}, {"s", "t"}, {"texture_u", "texture_v"}}) {
    const PlyMesh mesh = read_ply(
        std::string("ply\nformat ascii 1.0\nelement vertex 3\nproperty float ") + u +
        "\nproperty float nz\nproperty float ny\nproperty float nx\nproperty float x\n"
        "property float y\nproperty float z\nproperty float " +
        v +
        "\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
        "0 3 2 1 0 0 0 .5  1 3 2 1 1 0 0 .6  0 3 2 1 0 1 0 .7  3 0 1 2\n");
    EXPECT_EQ(mesh.normals, std::vector<Vec3>(3, {1, 2, 3}));
    EXPECT_EQ(mesh.uvs, (std::vector<Vec2>{{0, 0.5f}, {1, 0.6f}, {0, 0.7f}}));
  }
}

TEST(PlyTest, CutsPolygonsIntoTriangles) {
  const PlyMesh mesh = read_ply(
      "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\n"
      "property float z\nelement edge 1\nproperty list int float weights\n"
      "element face 3\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 0 1 0 0 2 1 0 1 2 0 0 1 0\n2 .5 .5\n4 0 1 2 3\n5 0 1 2 3 4\n2 0 1\n");
  EXPECT_EQ(mesh.triangles,
            (std::vector<Vec3i>{{0, 1, 2}, {0, 2, 3}, {0, 1, 2}, {0, 2, 3}, {0, 3, 4}}));
  EXPECT_TRUE(mesh.has_skipped_faces);
}

TEST(PlyTest, ReadsFilesOfManyExporters) {
  const std::filesystem::path folder = TYNDALL_SOURCE_DIR "/../shared/scenes/data/ply";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no shared scenes";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    SCOPED_TRACE(entry.path().string());
    const PlyMesh mesh = read_ply(read_bytes(entry.path().string()));
    EXPECT_GE(mesh.positions.size(), 3u);
    EXPECT_GE(mesh.triangles.size(), 1u);
  }
}

}  // namespace
}  // namespace tyndall::loader
