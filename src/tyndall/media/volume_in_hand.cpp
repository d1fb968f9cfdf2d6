// SPDX-License-Identifier: Apache-2.0
#include "tyndall/media/volume_in_hand.h"

#include <atomic>

namespace tyndall {
namespace {

std::atomic<const char*> name_in_hand{nullptr};
static_assert(std::atomic<const char*>::is_always_lock_free, "asked in signal handlers");

}  // namespace

VolumeInHand::VolumeInHand(const std::filesystem::path& path)
    : name_(path.string()), previous_(name_in_hand.exchange(name_.c_str())) {}

VolumeInHand::~VolumeInHand() { name_in_hand = previous_; }

const char* volume_in_hand() noexcept { return name_in_hand; }

}  // namespace tyndall
