// SPDX-License-Identifier: Apache-2.0
// The same fog, described in different ways, gives the same picture.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <tuple>

#include "image/temporary_folder.h"
#include "scenes.h"
#include "support/statistical_tests.h"
#include "support/volume_writer.h"
#include "tyndall/media/volume_file.h"

namespace tyndall {
namespace {

constexpr float sigma_s = 1.4f, sigma_a = 0.2f, g = 0.5f;
constexpr int side = 16, tile = 4, spp = 2500;

const Transform sheared = *Transform::from_matrix(
    {{{1, 0.4f, -0.2f, 0.1f}, {0, 1, 0.3f, 0}, {0, 0, 1, -0.2f}, {0, 0, 0, 1}}});
const Transform affine =
    sheared * Transform::rotate(40, {1, -2, 3}) * Transform::scale({-1.2f, 0.8f, 1.5f});

// Larger than the fog under all of these transforms.
Medium constant_nanovdb(const Transform& world_from_medium) {
  const TemporaryFolder folder;
  const std::string path = folder.file("one.nvdb");
  test::write_nvdb(path, {{.voxels = test::filled_box({-20, -20, -20}, {20, 20, 20}, 1),
                           .voxel_size = 0.2}});
  constexpr std::string_view names[] = {"density"};
  return Medium(GridMedium(read_volume(path, names), world_from_medium,
                           {Rgb(sigma_a), Rgb(sigma_s), Rgb(0)}, HenyeyGreenstein(g)));
}

// All of one value, in channels that differ only by rounding, if at all.
Medium constant_rgbgrid(const Transform& world_from_medium) {
  constexpr int n = 5;
  const auto grid = [&](float value) {
    return RgbGrid{{n, n, n}, std::vector<Rgb>(n * n * n, Rgb(value))};
  };
  // The outermost half cells fade to zero.
  return Medium(RgbGridMedium(
      {.sigma_a = grid(sigma_a), .sigma_s = grid(sigma_s), .Le = {}},
      {{-5, -5, -5}, {5, 5, 5}}, world_from_medium, 1, 1, HenyeyGreenstein(g)));
}

struct Description {
  const char* name;
  Medium (*medium)();
};
const Description descriptions[] = {
    {"Uniformgrid", [] { return test::constant_grid(sigma_s, sigma_a, g, 3); }},
    {"UniformgridAffine",
     [] { return test::constant_grid(sigma_s, sigma_a, g, 3, affine); }},
    {"Nanovdb", [] { return constant_nanovdb(Transform()); }},
    {"NanovdbAffine", [] { return constant_nanovdb(affine); }},
    {"RgbgridAffine", [] { return constant_rgbgrid(affine); }},
};

Image picture(Medium medium, const std::string& integrator, uint64_t seed) {
  SceneDescription d;
  d.camera = test::camera({0.3f, 0.2f, -2.8f}, {0, 0, 0}, 40, {side, side});
  d.media.push_back(std::move(medium));
  d.surfaces.push_back(test::boundary_sphere(1));
  d.surfaces.push_back(test::diffuse_disk(1.2f, 2, 0.6f));
  d.lights.push_back(Light(ConstantEnvironment{Rgb(0.6f)}));
  d.lights.push_back(Light(DistantLight{normalize({1, 2, -1}), Rgb(1.5f)}));
  RenderSettings s = test::settings(integrator, 30);
  s.resolution = s.crop_max = {side, side};
  s.samples_per_pixel = spp;
  s.seed = seed;
  const RenderResult result = render(Scene(std::move(d)), s);
  EXPECT_EQ(result.statistics.rejected.total(), 0);
  return result.film.develop();
}

struct Mean {
  double value = 0, variance = 0;
};

Mean mean_of(const Image& image, Vec2i first, int size) {
  Mean mean;
  const double weight = 1.0 / (size * size);
  for (int y = first.y; y < first.y + size; ++y)
    for (int x = first.x; x < first.x + size; ++x) {
      const size_t i = static_cast<size_t>(y * side + x);
      mean.value += weight * double{image.find("R")->values[i]};
      mean.variance += weight * weight * double{image.find("variance.R")->values[i]};
    }
  return mean;
}

double p_value(const Mean& a, const Mean& b) {
  return z_p_value(a.value - b.value, std::sqrt(a.variance + b.variance), 0);
}

class EqualMediaTest : public testing::TestWithParam<std::tuple<std::string, Description>> {
};
INSTANTIATE_TEST_SUITE_P(All, EqualMediaTest,
                         testing::Combine(testing::Values("volpath", "learned"),
                                          testing::ValuesIn(descriptions)),
                         [](const auto& instance) {
                           return std::get<0>(instance.param) +
                                  std::get<1>(instance.param).name;
                         });

TEST_P(EqualMediaTest, LookLikeHomogeneousFog) {
  const auto& [integrator, description] = GetParam();
  static std::map<std::string, Image> known;
  if (!known.contains(integrator))
    known.emplace(integrator, picture(test::grey_fog(sigma_s, sigma_a, g), integrator, 1));
  const Image& expected = known.at(integrator);
  const Image image = picture(description.medium(), integrator, 2);
  // Sixteen tiles and the whole, of each of the cases.
  const double alpha = sidak(0.01, 2 * 5 * (16 + 1));
  const Mean a = mean_of(image, {0, 0}, side), b = mean_of(expected, {0, 0}, side);
  EXPECT_GT(p_value(a, b), alpha) << a.value << " and " << b.value;
  // A bias of 1 % would be six standard errors and more.
  EXPECT_LT(std::sqrt(a.variance + b.variance), 0.01 / 6 * b.value);
  for (int y = 0; y < side; y += tile)
    for (int x = 0; x < side; x += tile)
      EXPECT_GT(p_value(mean_of(image, {x, y}, tile), mean_of(expected, {x, y}, tile)),
                alpha)
          << "tile at " << x << ", " << y;
}

}  // namespace
}  // namespace tyndall
