// SPDX-License-Identifier: Apache-2.0
#include "tyndall/guiding/guiding_file.h"

#include <stdexcept>
#include <string>

namespace tyndall {
namespace {

// 2: ends with a mark. 3: the scene has an origin.
constexpr uint32_t version = 3;

constexpr uint32_t name_of(const char (&letters)[5]) {
  uint32_t name = 0;
  for (int i = 3; i >= 0; --i) name = name << 8 | static_cast<unsigned char>(letters[i]);
  return name;
}

constexpr uint32_t magic = name_of("TYGF"), times = name_of("TIME"),
                   scene = name_of("SCNE"), visibility = name_of("VISM"),
                   records = name_of("RECS"), end = name_of("DONE");

void read_section(uint32_t name, ByteReader in, GuidingFile& file) {
  if (name == times) {
    in.read(file.seconds);
    in.read(file.training_seconds);
  } else if (name == scene) {
    file.scene = SceneMark::read(in);
  } else if (name == visibility) {
    const auto light = in.read_as<uint32_t>();
    std::optional<VisibilityMap> map = VisibilityMap::read(in);
    if (!map) throw std::runtime_error("a visibility map in it is damaged");
    file.maps[light] = std::make_shared<const VisibilityMap>(std::move(*map));
  } else if (name == records) {
    file.records = RecordCache::load(in);
    if (!file.records) throw std::runtime_error("its records are damaged");
  } else {
    return;
  }
  if (in.failed() || in.remaining() > 0)
    throw std::runtime_error("a section has the wrong length");
}

}  // namespace

GuidingFileWriter::GuidingFileWriter(ByteWriter& out) : out_(&out) {
  out.write(magic);
  out.write(version);
}

void GuidingFileWriter::add(uint32_t name, const std::function<void(ByteWriter&)>& write) {
  ByteWriter section;
  write(section);
  out_->write(name);
  out_->write(static_cast<uint64_t>(section.bytes().size()));
  out_->append(section.bytes());
}

void GuidingFileWriter::add_times(double seconds, double training_seconds) {
  add(times, [&](ByteWriter& out) { out.write(seconds), out.write(training_seconds); });
}

void GuidingFileWriter::add_scene(const SceneMark& mark) {
  add(scene, [&](ByteWriter& out) { mark.write(out); });
}

void GuidingFileWriter::add_map(size_t light, const VisibilityMap& map) {
  add(visibility, [&](ByteWriter& out) {
    out.write(static_cast<uint32_t>(light));
    map.write(out);
  });
}

void GuidingFileWriter::add_records(const RecordCache& cache) {
  add(records, [&](ByteWriter& out) { cache.write(out); });
}

void GuidingFileWriter::finish() {
  add(end, [](ByteWriter&) {});
}

GuidingFile read_guiding_file(std::span<const std::byte> bytes) {
  ByteReader in(bytes);
  if (in.read_as<uint32_t>() != magic)
    throw std::runtime_error("it is no file of --dump-guiding");
  const auto found = in.read_as<uint32_t>();
  if (in.failed()) throw std::runtime_error("it is cut off");
  if (found != version)
    throw std::runtime_error("its format has version " + std::to_string(found) +
                             ", this program reads version " + std::to_string(version));
  GuidingFile file;
  for (;;) {
    const auto name = in.read_as<uint32_t>();
    const auto size = in.read_as<uint64_t>();
    if (in.failed() || size > in.remaining()) throw std::runtime_error("it is cut off");
    if (name == end) break;
    read_section(name, ByteReader(in.take(static_cast<size_t>(size))), file);
  }
  if (in.remaining() > 0) throw std::runtime_error("something follows its end");
  return file;
}

}  // namespace tyndall
