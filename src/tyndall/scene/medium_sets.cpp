// SPDX-License-Identifier: Apache-2.0
#include "tyndall/scene/medium_sets.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <deque>
#include <map>
#include <mutex>
#include <type_traits>
#include <utility>
#include <vector>

#include "tyndall/sampling/random.h"

namespace tyndall {
namespace {

// Media with repetitions, sorted by address.
using Key = std::vector<const Medium*>;

std::vector<SingleMedium> distinct_parts(const Key& key) {
  std::vector<SingleMedium> parts;
  for (size_t i = 0; i < key.size(); ++i) {
    if (i > 0 && key[i] == key[i - 1]) continue;
    key[i]->visit([&](const auto& m) {
      if constexpr (!std::is_same_v<std::decay_t<decltype(m)>, OverlappingMedia>)
        parts.emplace_back(m);
    });
  }
  return parts;
}

// A step that was taken before.
struct Step {
  const Medium *current, *from, *to, *result;
};

uint64_t bits(const Medium* medium) { return reinterpret_cast<uintptr_t>(medium); }

}  // namespace

class MediumSets::Impl {
 public:
  explicit Impl(std::span<const Medium> media) {
    for (const Medium& medium : media) key_of_[&medium] = {&medium};
  }

  // Steps are remembered in a table that is read without locks.
  const Medium* cross(const Medium* current, const Medium* from, const Medium* to) {
    std::atomic<const Step*>& slot =
        steps_[hash(bits(current), bits(from), bits(to)) % steps_.size()];
    const Step* step = slot.load(std::memory_order_acquire);
    if (step && step->current == current && step->from == from && step->to == to)
      return step->result;
    const std::scoped_lock lock(mutex_);
    const Medium* result = find(current, from, to);
    if (taken_.size() < max_steps) {
      taken_.push_back({current, from, to, result});
      slot.store(&taken_.back(), std::memory_order_release);
    }
    return result;
  }

  bool contains(const Medium* current, const Medium* medium) {
    const std::scoped_lock lock(mutex_);
    return current && std::ranges::count(key_of_.at(current), medium) > 0;
  }

 private:
  static constexpr size_t max_steps = 1 << 16;

  const Medium* find(const Medium* current, const Medium* from, const Medium* to) {
    Key key = current ? key_of_.at(current) : Key();
    if (from) {
      const auto left = std::ranges::find(key, from);
      if (left == key.end()) return to;
      key.erase(left);
    }
    if (to) key.insert(std::ranges::upper_bound(key, to), to);
    return medium_of(key);
  }

  const Medium* medium_of(const Key& key) {
    if (key.empty()) return nullptr;
    if (key.size() == 1) return key.front();
    std::unique_ptr<const Medium>& made = made_[key];
    if (!made) {
      made = std::make_unique<const Medium>(OverlappingMedia(distinct_parts(key)));
      key_of_[made.get()] = key;
    }
    return made.get();
  }

  std::mutex mutex_;
  std::map<const Medium*, Key> key_of_;
  std::map<Key, std::unique_ptr<const Medium>> made_;
  std::deque<Step> taken_;
  std::array<std::atomic<const Step*>, 1024> steps_{};
};

MediumSets::MediumSets(std::span<const Medium> media)
    : impl_(std::make_unique<Impl>(media)) {}

MediumSets::~MediumSets() = default;

const Medium* MediumSets::cross_overlap(const Medium* current, const Medium* from,
                                        const Medium* to) const {
  return impl_->cross(current, from, to);
}

bool MediumSets::contains(const Medium* current, const Medium* medium) const {
  return current == medium || impl_->contains(current, medium);
}

}  // namespace tyndall
