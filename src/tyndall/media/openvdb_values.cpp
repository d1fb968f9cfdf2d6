// SPDX-License-Identifier: Apache-2.0
#include "tyndall/media/openvdb_values.h"

#include <zlib.h>

#include <array>
#include <cstring>

#include "tyndall/media/blosc_chunk.h"

namespace tyndall {
namespace {

// What precedes the values of a node, as openvdb::io has it.
constexpr uint8_t one_inactive_value = 2, mask = 3, mask_and_one_value = 4,
                  mask_and_two_values = 5, all_values = 6;

bool unzips(std::span<const std::byte> packed, std::span<std::byte> to) {
  uLongf size = to.size();
  return uncompress(reinterpret_cast<Bytef*>(to.data()), &size,
                    reinterpret_cast<const Bytef*>(packed.data()), packed.size()) == Z_OK &&
         size == to.size();
}

// What Blosc makes of nothing: version, flags, size of a value, and three numbers.
bool is_chunk_of_nothing(std::span<const std::byte> packed) {
  constexpr std::array<uint32_t, 3> sizes{0, 1, 16};
  constexpr unsigned not_packed = 2, reserved = 8;
  if (packed.size() != 16) return false;
  const auto flags = static_cast<unsigned>(packed[2]);
  return packed[0] == std::byte{2} && (flags & (not_packed | reserved)) == not_packed &&
         packed[3] != std::byte{0} &&
         std::memcmp(packed.data() + 4, sizes.data(), sizeof sizes) == 0;
}

BloscChunk chunk_of(std::span<const std::byte> packed) {
  const auto read_at = [packed](uint64_t offset, std::span<std::byte> to) {
    OpenVdbBytes::require(offset <= packed.size() && to.size() <= packed.size() - offset);
    std::memcpy(to.data(), packed.data() + offset, to.size());
  };
  return {read_at, packed.size()};
}

}  // namespace

void OpenVdbValueCheck::pass(uint32_t count, uint32_t active_count, bool is_unpacked) {
  const auto kind = bytes_.number<uint8_t>();
  const bool is_active_only = values_.flags & OpenVdbValues::active_only;
  OpenVdbBytes::require(kind <= all_values && (is_active_only || kind == all_values));
  if (kind == one_inactive_value || kind == mask_and_one_value) bytes_.skip(values_.size);
  if (kind == mask_and_two_values) bytes_.skip(2 * uint64_t{values_.size});
  if (kind >= mask && kind <= mask_and_two_values) bytes_.skip(count / 8);
  const uint32_t stored_count = kind == all_values ? count : active_count;
  // Without numbers to be halved there is nothing, not even the size of nothing.
  if (stored_count == 0 && values_.stored_size < values_.size) return;
  pass_chunk(uint64_t{stored_count} * values_.stored_size, is_unpacked);
}

void OpenVdbValueCheck::pass_chunk(uint64_t size, bool is_unpacked) {
  if (!(values_.flags & (OpenVdbValues::zip | OpenVdbValues::blosc)))
    return bytes_.skip(size);
  // Negative: of values that are not packed.
  const auto packed_size = bytes_.number<int64_t>();
  if (packed_size > 0)
    return pass_packed(static_cast<uint64_t>(packed_size), size, is_unpacked);
  OpenVdbBytes::require(uint64_t{0} - static_cast<uint64_t>(packed_size) == size);
  bytes_.skip(size);
}

void OpenVdbValueCheck::pass_packed(uint64_t packed_size, uint64_t size, bool is_unpacked) {
  OpenVdbBytes::require(packed_size <= bytes_.left());
  const bool is_blosc = values_.flags & OpenVdbValues::blosc;
  if (!is_blosc && !is_unpacked) return bytes_.skip(packed_size);
  packed_.resize(packed_size);
  bytes_.read(packed_);
  unpacked_.resize(size);
  if (!is_blosc) return OpenVdbBytes::require(unzips(packed_, unpacked_));
  if (size == 0) return OpenVdbBytes::require(is_chunk_of_nothing(packed_));
  BloscChunk chunk = chunk_of(packed_);
  OpenVdbBytes::require(chunk.size() == size);
  if (is_unpacked) chunk.read(unpacked_);
}

}  // namespace tyndall
