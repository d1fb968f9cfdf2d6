// SPDX-License-Identifier: Apache-2.0
#include "apps/image_command_test.h"
#include "tyndall/image/false_color.h"

namespace tyndall::app {
namespace {

class ConvertCommandTest : public ImageCommandTest {
 protected:
  /// Converts to `name`, expects success, and reads the result.
  Image convert(const std::string& input, const std::string& name,
                const std::vector<std::string>& options = {}) {
    std::vector<std::string> words = {"convert", input, folder.file(name)};
    words.insert(words.end(), options.begin(), options.end());
    EXPECT_EQ(run(words), ExitCode::done) << err;
    return read_image(folder.file(name));
  }
};

TEST_F(ConvertCommandTest, ChangesTheFormat) {
  const std::string a = write("a.exr", 1);
  EXPECT_EQ(convert(a, "a.pfm").rgb(3, 2), Rgb(4));
  EXPECT_EQ(convert(a, "a.hdr").rgb(3, 2), Rgb(4));
  EXPECT_EQ(convert(a, "a.png").rgb(3, 2), Rgb(1));
  EXPECT_EQ(convert(a, "b.exr", {"--half"}).find("depth.Z")->values,
            read_image(a).find("depth.Z")->values);
  EXPECT_EQ(out, "");
}

TEST_F(ConvertCommandTest, ExposesColourAndItsVariance) {
  const Image image = convert(write("a.exr", 1), "b.exr", {"--exposure", "-2"});
  EXPECT_EQ(image.rgb(3, 2), Rgb(1));
  EXPECT_FLOAT_EQ(image.rgb(3, 2, "variance").r, 0.01f / 16);
  EXPECT_EQ(image.find("depth.Z")->values[8], 1);
}

TEST_F(ConvertCommandTest, AppliesTheCurve) {
  const Image image = convert(write("a.exr", 1), "a.png", {"--tone", "filmic"});
  EXPECT_NEAR(image.rgb(0, 0).r, 2.54f / 3.16f, 0.01f);
}

TEST_F(ConvertCommandTest, CropsAndKnowsWhere) {
  const std::string a = write("a.exr", 1);
  const Image part = convert(a, "b.exr", {"--crop", "2,1,5,6"});
  EXPECT_EQ(part.width(), 3);
  EXPECT_EQ(part.height(), 5);
  EXPECT_EQ(part.rgb(0, 0), Rgb(3));
  EXPECT_EQ(part.offset, (Vec2i{2, 1}));
  EXPECT_EQ(part.full_size, (Vec2i{8, 6}));
  EXPECT_EQ(run({"convert", a, folder.file("b.exr"), "--crop", "20,20,30,30"}),
            ExitCode::usage);
  EXPECT_EQ(err, "error: the crop window holds no pixel of the 8 x 6 image\n");
}

TEST_F(ConvertCommandTest, SelectsLayers) {
  const std::string a = write("a.exr", 1);
  EXPECT_EQ(convert(a, "b.pfm", {"--layer", "depth"}).rgb(0, 4), Rgb(4));
  EXPECT_EQ(convert(a, "b.pfm", {"--layer", "depth.Z"}).rgb(0, 4), Rgb(4));
  EXPECT_EQ(convert(a, "b.pfm", {"--layer", "variance"}).rgb(0, 4), Rgb(0.01f));
  EXPECT_EQ(run({"convert", a, folder.file("b.pfm"), "--layer", "albedo"}),
            ExitCode::scene);
  EXPECT_EQ(err,
            "error: " + a +
                ": there is no layer \"albedo\"; there are B, G, R, depth, variance\n");
}

TEST_F(ConvertCommandTest, ShowsErrors) {
  const std::string a = write("a.exr", 1), r = write("r.exr", 1.5f);
  const auto error = [&](const std::string& kind) {
    return convert(a, "e.pfm", {"--reference", r, "--error", kind}).rgb(0, 0).g;
  };
  EXPECT_EQ(error("difference"), -0.5f);
  EXPECT_EQ(error("absolute"), 0.5f);
  EXPECT_FLOAT_EQ(error("relative"), 0.25f / 2.26f);
  EXPECT_EQ(error("flip"), 0);  // both clip to white
  EXPECT_GT(error("hdr-flip"), 0.01f);
}

TEST_F(ConvertCommandTest, SplitsTwoImages) {
  const Image image = convert(write("a.exr", 1), "s.pfm",
                              {"--split", write("b.exr", 2), "--exposure", "1"});
  EXPECT_EQ(image.rgb(3, 2), Rgb(2 * (1 + 3)));
  EXPECT_EQ(image.rgb(4, 2), Rgb(2 * (2 + 4)));
}

TEST_F(ConvertCommandTest, ShowsFalseColor) {
  const std::string a = write("a.exr", 1);
  const Image given = convert(a, "f.pfm", {"--false-color", "--range", "1,8"});
  EXPECT_EQ(out, "false color from 1 (black) to 8 (pale yellow)\n");
  EXPECT_EQ(given.rgb(7, 0), false_color(1));
  EXPECT_EQ(given.rgb(0, 0), false_color(0));
  EXPECT_EQ(convert(a, "f.pfm", {"--false-color"}).rgb(0, 0), false_color(1 / 8.0f));
  EXPECT_EQ(out, "false color from 0 (black) to 8 (pale yellow)\n");
}

TEST_F(ConvertCommandTest, ReportsWrongArguments) {
  const std::string a = write("a.exr", 1), b = folder.file("b.exr");
  EXPECT_EQ(run({"convert", a, b, "--error", "flip"}), ExitCode::usage);
  EXPECT_EQ(err, "error: --error needs --reference\n");
  EXPECT_EQ(run({"convert", a, b, "--reference", a}), ExitCode::usage);
  EXPECT_EQ(err, "error: --reference needs --error\n");
  EXPECT_EQ(run({"convert", a, b, "--error", "flip", "--reference", a, "--split", a}),
            ExitCode::usage);
  EXPECT_EQ(err, "error: --error and --split exclude each other\n");
  EXPECT_EQ(run({"convert", a, b, "--range", "0,1"}), ExitCode::usage);
  EXPECT_EQ(err, "error: --range needs --false-color\n");
  EXPECT_EQ(run({"convert", a, b, "--false-color", "--range", "1,1"}), ExitCode::usage);
  EXPECT_NE(err.find("must be LOW,HIGH with LOW below HIGH, got '1,1'"), std::string::npos);
}

TEST_F(ConvertCommandTest, ReportsFiles) {
  const std::string a = write("a.exr", 1), other = write("o.exr", 1, 3, 3);
  EXPECT_EQ(run({"convert", a, folder.file("b.tiff")}), ExitCode::usage);
  EXPECT_EQ(
      err,
      "error: " + folder.file("b.tiff") +
          ": unknown image extension \".tiff\"; known are .exr, .hdr, .pfm and .png\n");
  EXPECT_EQ(run({"convert", folder.file("x.exr"), folder.file("b.exr")}), ExitCode::scene);
  EXPECT_EQ(
      err, "error: " + folder.file("x.exr") + ": cannot read: No such file or directory\n");
  EXPECT_EQ(
      run({"convert", a, folder.file("b.exr"), "--reference", other, "--error", "flip"}),
      ExitCode::scene);
  EXPECT_EQ(err, "error: " + a + ": the image has 8 x 6 pixels, the reference 3 x 3\n");
  EXPECT_FALSE(std::filesystem::exists(folder.file("b.exr")));
}

}  // namespace
}  // namespace tyndall::app
