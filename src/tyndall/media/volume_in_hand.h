// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace tyndall {

/// While one of these lives, a volume file is being read, by code that damage in the file
/// may crash: OpenVDB checks hardly anything that it reads.
class VolumeInHand {
 public:
  explicit VolumeInHand(const std::filesystem::path& path);
  ~VolumeInHand();
  VolumeInHand(const VolumeInHand&) = delete;
  VolumeInHand& operator=(const VolumeInHand&) = delete;

 private:
  std::string name_;
  const char* previous_;
};

/// The name of the volume file that is being read, null if there is none: what a signal
/// handler may ask for to say what the program died of.
const char* volume_in_hand() noexcept;

}  // namespace tyndall
