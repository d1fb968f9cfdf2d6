// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <span>

#include "tyndall/guiding/byte_stream.h"
#include "tyndall/guiding/record_cache.h"
#include "tyndall/guiding/scene_mark.h"
#include "tyndall/guiding/visibility_map.h"

namespace tyndall {

/// Writes the file of what a render has learned: a magic number, a version, then sections,
/// each with a name of four letters and its length, the last one an empty mark. Readers
/// skip sections that they do not know.
class GuidingFileWriter {
 public:
  explicit GuidingFileWriter(ByteWriter& out);

  void add_times(double seconds, double training_seconds);
  void add_scene(const SceneMark& mark);
  void add_map(size_t light, const VisibilityMap& map);
  void add_records(const RecordCache& records);
  /// To be called once, at the end: files without its mark are taken to be cut off.
  void finish();

 private:
  void add(uint32_t name, const std::function<void(ByteWriter&)>& write);

  ByteWriter* out_;
};

/// What such a file holds.
struct GuidingFile {
  double seconds = 0, training_seconds = 0;
  std::optional<SceneMark> scene;  ///< in which it was learned
  /// By the light's index in Scene::lights().
  std::map<size_t, std::shared_ptr<const VisibilityMap>> maps;
  std::optional<RecordCache> records;
};

/// Throws std::runtime_error with a sentence about what is wrong with the bytes.
GuidingFile read_guiding_file(std::span<const std::byte> bytes);

}  // namespace tyndall
