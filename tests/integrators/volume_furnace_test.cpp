// SPDX-License-Identifier: Apache-2.0
// Measured volumes of albedo one in surroundings of radiance one: they vanish.
#include <gtest/gtest.h>

#include <filesystem>

#include "scenes.h"
#include "support/statistical_tests.h"
#include "support/surfaces.h"
#include "support/volume_writer.h"
#include "tyndall/media/volume_file.h"

namespace tyndall {
namespace {

const std::filesystem::path volumes =
    std::filesystem::path(TYNDALL_SOURCE_DIR) / ".." / "shared/scenes/data/vdb";

struct VolumeCase {
  std::string file;
  float optical_depth;  // about, across the box, of the densest part
};

class VolumeFurnaceTest : public testing::TestWithParam<VolumeCase> {};
INSTANTIATE_TEST_SUITE_P(Files, VolumeFurnaceTest,
                         testing::Values(VolumeCase{"shadeops_teapot_cloud.nvdb", 100},
                                         VolumeCase{"ovdb_smoke1.vdb", 30},
                                         VolumeCase{"fvdb_smoke-blosc.nvdb", 30}));

TEST_P(VolumeFurnaceTest, DenseCloudOfAlbedoOne) {
  const std::filesystem::path path = volumes / GetParam().file;
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not here";
  if (path.extension() == ".vdb" && !test::has_openvdb) GTEST_SKIP() << "no OpenVDB";
  constexpr std::string_view names[] = {"density"};
  const PlacedGrid grid = read_volume(path, names);
  const Transform turned =
      Transform::rotate(30, {1, 2, 3}) * Transform::scale({1, -1.2f, 0.9f});
  const Bounds3 box = (turned * grid.medium_from_grid).bounds(grid.box);
  const float size = length(box.diagonal());
  const float sigma = GetParam().optical_depth / (grid.grid->maximum() * size);
  for (const float g : {0.0f, 0.8f}) {
    SceneDescription d;
    const Vec3 eye = box.center() - Vec3{0, 0, 2 * size};
    d.camera = test::camera(eye, box.center());
    d.media.push_back(Medium(
        GridMedium(grid, turned, {Rgb(0), Rgb(sigma), Rgb(0)}, HenyeyGreenstein(g))));
    d.surfaces.push_back(test::box_boundary(box.min, box.max, 0, no_medium));
    d.lights.push_back(Light(ConstantEnvironment{Rgb(1)}));
    const Scene scene(std::move(d));
    const auto look = [&](const std::string& integrator, int count) {
      return test::estimate(
          scene, test::settings(integrator, 1'000'000), count, [&](Sampler& sampler) {
            const Vec2 u = sampler.next_2d();
            const Vec3 target = box.min + box.diagonal() * Vec3{u.x, u.y, 0.5f};
            return Ray{eye, normalize(target - eye)};
          });
    };
    for (const std::string integrator : {"volpath", "learned"}) {
      const RunningMoments moments = look(integrator, 4000);
      EXPECT_LT(moments.standard_error(), 0.02) << integrator;
      EXPECT_GT(z_p_value(moments, 1), sidak(0.01, 12))
          << integrator << ": " << moments.mean() << " +- " << moments.standard_error();
    }
  }
}

}  // namespace
}  // namespace tyndall
