// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "apps/image_command_test.h"
#include "tyndall/image/whole_file.h"

namespace tyndall::app {
namespace {

using CompareCommandTest = ImageCommandTest;

TEST_F(CompareCommandTest, PrintsATable) {
  const std::string a = write("a.exr", 1.5f), reference = write("r.exr", 1);
  EXPECT_EQ(run({"compare", a, "--reference", reference, "--no-flip", "--epsilon", "0.25"}),
            ExitCode::done);
  EXPECT_EQ(err, "");
  EXPECT_NE(out.find("reference: " + reference +
                     " (8 x 6)\nrelMSE with epsilon 0.25; trimmed: "
                     "without the worst 0.1 % of the pixels;"),
            std::string::npos)
      << out;
  const std::string spaces(a.size() - 5, ' ');
  EXPECT_NE(out.find("image" + spaces + "   relMSE  trimmed   MSE   SMAPE"),
            std::string::npos)
      << out;
  EXPECT_NE(out.find("0.25"), std::string::npos) << out;
  EXPECT_NE(out.find("+0.5 +- 0.04"), std::string::npos) << out;  // 1.96 sqrt(0.02 / 48)
}

TEST_F(CompareCommandTest, PrintsJson) {
  const std::string a = write("a.exr", 1.5f), b = write("b.exr", 1);
  const std::string reference = write("r.exr", 1);
  EXPECT_EQ(run({"compare", a, b, "--reference", reference, "--json", "--exposure", "-4"}),
            ExitCode::done);
  const nlohmann::json object = nlohmann::json::parse(out);
  EXPECT_EQ(object["reference"], reference);
  EXPECT_EQ(object["epsilon"], 0.01);
  EXPECT_EQ(object["images"][0]["path"], a);
  EXPECT_EQ(object["images"][0]["mse"], 0.25);
  EXPECT_GT(object["images"][0]["ldr_flip"], 0);
  EXPECT_EQ(object["images"][0]["bias"]["mean_difference"], 0.5);
  EXPECT_EQ(object["images"][0]["bias"]["rejected_tiles"], 1);
  EXPECT_EQ(object["images"][1]["mse"], 0);
  EXPECT_EQ(object["images"][1]["psnr"], nullptr);  // infinite
  EXPECT_EQ(object["images"][1]["bias"]["p_value"], 1);
}

TEST_F(CompareCommandTest, ChecksLimits) {
  const std::string a = write("a.exr", 1.5f), reference = write("r.exr", 1);
  EXPECT_EQ(run({"compare", a, "--reference", reference, "--max-relmse", "0.001"}),
            ExitCode::check_failed);
  EXPECT_NE(err.find("error: " + a + ": relMSE 0.0"), std::string::npos) << err;
  EXPECT_NE(err.find(" is above 0.001\n"), std::string::npos) << err;
  EXPECT_EQ(run({"compare", a, "--reference", reference, "--max-relmse", "1"}),
            ExitCode::done);
  EXPECT_EQ(run({"compare", a, "--reference", reference, "--max-flip", "1e-9"}),
            ExitCode::done);  // both are white on a display
}

TEST_F(CompareCommandTest, CountsPixelsThatAreNotFinite) {
  const std::string a = write("a.exr", 1), reference = write("r.exr", 1);
  Image image = read_image(a);
  image.set_rgb(2, 2, Rgb(std::nanf("")));
  write_image(image, a);
  EXPECT_EQ(run({"compare", a, "--reference", reference, "--no-flip"}), ExitCode::done);
  EXPECT_NE(out.find(a + ": 1 pixels are not finite and left out\n"), std::string::npos)
      << out;
  EXPECT_EQ(run({"compare", a, "--reference", reference, "--no-flip", "--max-relmse", "1"}),
            ExitCode::check_failed);
  EXPECT_EQ(err, "error: " + a + ": 1 pixels are not finite\n");
  EXPECT_EQ(run({"compare", reference, "--reference", a, "--no-flip"}), ExitCode::done);
  EXPECT_NE(out.find(a + ": 1 pixels are not finite and left out\n"), std::string::npos)
      << out;
}

TEST_F(CompareCommandTest, SaysWhenVarianceIsMissing) {
  const std::string a = write("a.exr", 1), reference = write("r.exr", 1);
  const std::string plain = folder.file("plain.pfm");
  write_image(read_image(a), plain);
  EXPECT_EQ(run({"compare", plain, "--reference", reference, "--no-flip"}), ExitCode::done);
  EXPECT_NE(out.find(plain + ": no variance layer, so no bias test\n"), std::string::npos);
  EXPECT_EQ(run({"compare", a, "--reference", plain, "--no-flip"}), ExitCode::done);
  EXPECT_NE(out.find(plain + ": no variance layer; the bias test takes it as exact\n"),
            std::string::npos);
}

TEST_F(CompareCommandTest, RefusesTheReferenceAsImage) {
  const std::string a = write("a.exr", 1);
  EXPECT_EQ(run({"compare", a, "--reference", a}), ExitCode::usage);
  EXPECT_EQ(err, "error: the reference " + a + " is also one of the images\n");
  std::filesystem::create_symlink(a, folder.file("b.exr"));
  EXPECT_EQ(run({"compare", folder.file("b.exr"), "--reference", a}), ExitCode::usage);
}

TEST_F(CompareCommandTest, ReportsWhatCannotBeCompared) {
  const std::string a = write("a.exr", 1), reference = write("r.exr", 1, 6, 8);
  EXPECT_EQ(run({"compare", a, "--reference", reference}), ExitCode::scene);
  EXPECT_EQ(err, "error: " + a + ": the image has 8 x 6 pixels, the reference 6 x 8\n");
  Image depth(6, 8);
  depth.channel("depth.Z");
  write_image(depth, folder.file("depth.exr"));
  EXPECT_EQ(run({"compare", folder.file("depth.exr"), "--reference", reference}),
            ExitCode::scene);
  EXPECT_EQ(err, "error: " + folder.file("depth.exr") +
                     ": the image has no R, G and B channels\n");
  EXPECT_EQ(run({"compare", folder.file("x.exr"), "--reference", a}), ExitCode::scene);
  EXPECT_EQ(
      err, "error: " + folder.file("x.exr") + ": cannot read: No such file or directory\n");
}

TEST_F(CompareCommandTest, ReportsATruncatedFile) {
  const std::string a = write("a.exr", 1), reference = write("r.exr", 1);
  std::filesystem::resize_file(a, std::filesystem::file_size(a) / 2);
  EXPECT_EQ(run({"compare", a, "--reference", reference}), ExitCode::scene);
  EXPECT_EQ(err, "error: " + a + ": cannot read: the file ends too early\n");
}

TEST_F(CompareCommandTest, ReportsWrongArguments) {
  const std::string a = write("a.exr", 1), r = write("r.exr", 1);
  EXPECT_EQ(run({"compare", a, "--reference", r, "--epsilon", "0"}), ExitCode::usage);
  EXPECT_EQ(err, "error: --epsilon must be above 0, got 0\n");
  EXPECT_EQ(run({"compare", a, "--reference", r, "--trim", "1"}), ExitCode::usage);
  EXPECT_EQ(err, "error: --trim must lie in [0, 1), got 1\n");
  EXPECT_EQ(run({"compare", a, "--reference", r, "--no-flip", "--max-flip", "1"}),
            ExitCode::usage);
  EXPECT_EQ(err, "error: --max-flip needs FLIP, which --no-flip leaves out\n");
}

}  // namespace
}  // namespace tyndall::app
