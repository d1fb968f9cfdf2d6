// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "apps/tyndall/commands.h"
#include "image/temporary_folder.h"
#include "tyndall/image/io.h"

namespace tyndall::app {

/// Runs the subcommands that work on images, in a folder of their own, and keeps what they
/// print.
class ImageCommandTest : public testing::Test {
 protected:
  ExitCode run(const std::vector<std::string>& words) {
    Program program("tyndall", "A program.", "tyndall 0");
    add_compare_command(program);
    add_convert_command(program);
    std::vector<const char*> arguments = {"tyndall"};
    for (const std::string& word : words) arguments.push_back(word.c_str());
    testing::internal::CaptureStderr();
    testing::internal::CaptureStdout();
    const ExitCode code = program.run(static_cast<int>(arguments.size()), arguments.data());
    out = testing::internal::GetCapturedStdout();
    err = testing::internal::GetCapturedStderr();
    return code;
  }

  /// Writes an image of which pixel (x, y) is `value` + x; returns the path.
  std::string write(const std::string& name, float value, int width = 8, int height = 6) {
    Image image(width, height);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        image.set_rgb(x, y, Rgb(value + static_cast<float>(x)));
        image.set_rgb(x, y, Rgb(0.01f), "variance");
        image.channel("depth.Z").values[image.index(x, y)] = static_cast<float>(y);
      }
    }
    write_image(image, folder.file(name));
    return folder.file(name);
  }

  TemporaryFolder folder;
  std::string out, err;
};

}  // namespace tyndall::app
