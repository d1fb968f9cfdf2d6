// SPDX-License-Identifier: Apache-2.0
// Files of every format: round trips, foreign files, broken files.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "image/temporary_folder.h"
#include "tyndall/image/io.h"
#include "tyndall/image/whole_file.h"

namespace tyndall {
namespace {

Image gradient(int width, int height) {
  Image image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      image.set_rgb(x, y,
                    {static_cast<float>(x) * 0.1f, static_cast<float>(y) * 1e-4f,
                     static_cast<float>(x * y) * 1e4f});
    }
  }
  return image;
}

TEST(ImageFilesTest, PfmKeepsEveryBit) {
  const TemporaryFolder folder;
  Image image = gradient(5, 3);
  image.set_rgb(0, 0, {-0.0f, std::numeric_limits<float>::infinity(), 1e-42f});
  write_image(image, folder.file("a.pfm"));
  const Image back = read_image(folder.file("a.pfm"));
  for (const char* name : {"R", "G", "B"}) {
    EXPECT_EQ(back.find(name)->values, image.find(name)->values);
  }
}

TEST(ImageFilesTest, ReadsBigEndianGreyPfmBottomRowFirst) {
  const TemporaryFolder folder;
  using std::string_literals::operator""s;
  write_whole_file(folder.file("a.pfm"), "Pf\n1 2\n1.0\n\x3f\x80\0\0\x40\0\0\0"s);
  const Image image = read_image(folder.file("a.pfm"));
  EXPECT_EQ(image.rgb(0, 0), Rgb(2));
  EXPECT_EQ(image.rgb(0, 1), Rgb(1));
}

TEST(ImageFilesTest, HdrKeepsAPartIn256) {
  const TemporaryFolder folder;
  Image image = gradient(9, 4);
  image.set_rgb(3, 3, {0.9999f, 0.5f, 0});
  write_image(image, folder.file("a.hdr"));
  const Image back = read_image(folder.file("a.hdr"));
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 9; ++x) {
      const Rgb a = image.rgb(x, y), b = back.rgb(x, y);
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(a[c], b[c], max_component(a) / 255) << x << " " << y;
    }
  }
}

TEST(ImageFilesTest, HdrTurnsWhatItCannotHoldIntoBlack) {
  const TemporaryFolder folder;
  Image image(3, 1);
  image.set_rgb(0, 0, Rgb(1e-38f));
  image.set_rgb(1, 0, {-1, 0, 0});
  image.set_rgb(2, 0, Rgb(std::numeric_limits<float>::quiet_NaN()));
  write_image(image, folder.file("a.hdr"));
  for (int x = 0; x < 3; ++x) EXPECT_EQ(read_image(folder.file("a.hdr")).rgb(x, 0), Rgb(0));
}

// A row of eight pixels in the coding of 1991: a run of 5 and 3 literal bytes per
// component.
TEST(ImageFilesTest, ReadsRunLengthCodedHdr) {
  const TemporaryFolder folder;
  std::string bytes =
      "#?RADIANCE\n# comment\nEXPOSURE= 2\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 8\n";
  bytes += std::string("\x02\x02\x00\x08", 4);
  for (int component = 0; component < 3; ++component) bytes += "\x85\x80\x03\x40\x40\x40";
  bytes += "\x88\x82";
  write_whole_file(folder.file("a.hdr"), bytes);
  const Image image = read_image(folder.file("a.hdr"));
  EXPECT_EQ(image.rgb(4, 0), Rgb(1));  // 128/256 * 2^2 / exposure
  EXPECT_EQ(image.rgb(5, 0), Rgb(0.5f));
}

TEST(ImageFilesTest, ReadsOldRepeatsInHdr) {
  const TemporaryFolder folder;
  std::string bytes = "#?RGBE\n\n-Y 1 +X 4\n";
  bytes += "\x80\x40\x20\x81\x01\x01\x01\x03";
  write_whole_file(folder.file("a.hdr"), bytes);
  EXPECT_EQ(read_image(folder.file("a.hdr")).rgb(3, 0), Rgb(1, 0.5f, 0.25f));
}

TEST(ImageFilesTest, PngKeepsAllEightBitValues) {
  const TemporaryFolder folder;
  Image image(256, 1);
  for (int x = 0; x < 256; ++x) {
    image.set_rgb(x, 0,
                  {linear_from_srgb8(static_cast<uint8_t>(x)),
                   linear_from_srgb8(static_cast<uint8_t>(255 - x)), 0});
  }
  write_image(image, folder.file("a.png"));
  const Image back = read_image(folder.file("a.png"));
  for (const char* name : {"R", "G", "B"}) {
    EXPECT_EQ(back.find(name)->values, image.find(name)->values);
  }
  EXPECT_EQ(back.find("A"), nullptr);
}

TEST(ImageFilesTest, PngTakesExposure) {
  const TemporaryFolder folder;
  Image image(1, 1);
  image.set_rgb(0, 0, Rgb(0.125f));
  write_image(image, folder.file("a.PNG"), {.tone = {.exposure = 3}});
  EXPECT_EQ(read_image(folder.file("a.PNG")).rgb(0, 0), Rgb(1));
}

std::string bytes_from_hex(const std::string& hex) {
  std::string bytes;
  for (size_t i = 0; i < hex.size(); i += 2) {
    bytes += static_cast<char>(std::stoi(hex.substr(i, 2), nullptr, 16));
  }
  return bytes;
}

// Both files were made with Python's zlib and struct, without a PNG library: two pixels of
// 8-bit grey and alpha, (255, 128) and (188, 255); one of linear 16-bit RGB (gAMA 1),
// (65535, 32768, 0).
TEST(ImageFilesTest, ReadsGreyPngWithAlpha) {
  const TemporaryFolder folder;
  write_whole_file(
      folder.file("a"),
      bytes_from_hex(
          "89504e470d0a1a0a0000000d49484452000000020000000108040000005e2bb701"
          "0000000d49444154789c63f8dfb0e73f0007f8033b933dc7420000000049454e44ae426082"));
  const Image image = read_image(folder.file("a"));
  EXPECT_EQ(image.rgb(0, 0), Rgb(1));
  EXPECT_EQ(image.rgb(1, 0), Rgb(linear_from_srgb8(188)));
  EXPECT_EQ(image.find("A")->values, (std::vector<float>{128 / 255.0f, 1}));
}

TEST(ImageFilesTest, ReadsSixteenBitLinearPng) {
  const TemporaryFolder folder;
  write_whole_file(
      folder.file("a"),
      bytes_from_hex(
          "89504e470d0a1a0a0000000d49484452000000010000000110020000"
          "00c0e78f9d0000000467414d41000186a031e8965f0000000f49444154789c63f8ffbf81818101"
          "000cfc027fa37794cc0000000049454e44ae426082"));
  EXPECT_EQ(read_image(folder.file("a")).rgb(0, 0), Rgb(1, 32768 / 65535.0f, 0));
}

TEST(ImageFilesTest, ReportsUnknownExtensions) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.jpeg");
  const std::string expected =
      path + ": unknown image extension \".jpeg\"; known are .exr, .hdr, .pfm and .png";
  EXPECT_EQ(message_of([&] { write_image(gradient(1, 1), path); }), expected);
  EXPECT_EQ(message_of([&] { check_writable(path); }), expected);
  EXPECT_EQ(folder.file_count(), 0u);
}

TEST(ImageFilesTest, ReportsUnwritablePaths) {
  const TemporaryFolder folder;
  const std::string path = folder.file("none/a.exr");
  const std::string expected = path + ": cannot write: No such file or directory";
  EXPECT_EQ(message_of([&] { write_image(gradient(1, 1), path); }), expected);
  EXPECT_EQ(message_of([&] { check_writable(path); }), expected);
  EXPECT_EQ(message_of([&] { check_writable(folder.file("a.exr")); }), "");
  EXPECT_EQ(folder.file_count(), 0u);
}

TEST(ImageFilesTest, ReportsImagesWithoutColour) {
  const TemporaryFolder folder;
  Image image(2, 2);
  image.channel("depth.Z");
  for (const char* name : {"a.png", "a.pfm", "a.hdr"}) {
    const std::string path = folder.file(name);
    EXPECT_EQ(message_of([&] { write_image(image, path); }),
              path + ": cannot write: the image has no R, G and B channels");
  }
}

TEST(ImageFilesTest, ReportsWhatItCannotRead) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.exr");
  const auto message = [&](const std::string& bytes) {
    write_whole_file(path, bytes);
    return message_of([&] { read_image(path); });
  };
  const std::string start = path + ": cannot read: ";
  EXPECT_EQ(message(""), start + "the file is empty");
  EXPECT_EQ(message("GIF89a"), start + "not an EXR, PNG, PFM or Radiance HDR file");
  EXPECT_EQ(message("PF\n2 x\n-1\n"),
            start + "the PFM header has \"x\" where its height belongs");
  EXPECT_EQ(message("PF\n2 2\n-1\nabcd"),
            start + "the file ends after 4 of 48 bytes of pixels");
  EXPECT_EQ(message("PF\n2000000 2000000\n-1\nabcd"),
            start + "2000000 x 2000000 pixels; an image has from 1 to 2^28 pixels");
  EXPECT_EQ(message("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n"),
            start + "unsupported pixel format \"32-bit_rle_xyze\"");
  EXPECT_EQ(message("#?RADIANCE\n\n+Y 1 +X 1\n"),
            start + "unsupported orientation \"+Y 1 +X 1\"");
  EXPECT_EQ(message("#?RADIANCE\n\n-Y 1 +X 2\nabcd"),
            start + "the file ends in the middle of its pixels");
  EXPECT_EQ(message("#?RADIANCE\n"), start + "the header has no end");
  EXPECT_EQ(message(std::string("#?RADIANCE\n\n-Y 1 +X 8\n\x02\x02\x00\x08\x89x", 28)),
            start + "a run of equal bytes leaves its scanline");
}

/// True if the file is refused or is read as `expected`.
bool refused_or_equal(const std::string& path, const Image& expected) {
  try {
    return read_image(path).find("B")->values == expected.find("B")->values;
  } catch (const std::runtime_error&) {
    return true;
  }
}

// Every so many prefixes and single broken bytes: an exception or an image, never a crash
// (run it under the address sanitizer).
TEST(ImageFilesTest, SurvivesBrokenFiles) {
  const TemporaryFolder folder;
  for (const std::string name : {"a.exr", "a.hdr", "a.pfm", "a.png"}) {
    write_image(gradient(20, 18), folder.file(name));
    const Image image = read_image(folder.file(name));
    const std::string bytes = read_whole_file(folder.file(name));
    const std::string broken = folder.file("broken-" + name);
    const size_t step = bytes.size() / 150 + 1;
    for (size_t i = 0; i < bytes.size(); i += step) {
      write_whole_file(broken, std::string_view(bytes).substr(0, i));
      EXPECT_TRUE(refused_or_equal(broken, image)) << name << " cut at " << i;
      std::string changed = bytes;
      changed[i] = static_cast<char>(changed[i] ^ 0x55);
      write_whole_file(broken, changed);
      message_of([&] { read_image(broken); });
    }
  }
}

}  // namespace
}  // namespace tyndall
