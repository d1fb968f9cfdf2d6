// SPDX-License-Identifier: Apache-2.0
#include "tyndall/loader/load_scene.h"

#include <cerrno>
#include <memory>
#include <stdexcept>

#include "tyndall/loader/better_origin.h"
#include "tyndall/loader/files.h"
#include "tyndall/loader/parser.h"
#include "tyndall/loader/reporter.h"
#include "tyndall/loader/scene_builder.h"
#include "tyndall/loader/source_library.h"

namespace tyndall {
namespace {

struct Reading {
  LoadedScene loaded;
  std::optional<Vec3d> better_origin;
};

Reading read_about(std::optional<Vec3d> origin, std::shared_ptr<const std::string> text,
                   const std::string& name, const LoadOptions& options) {
  using namespace loader;
  const auto size = static_cast<uint32_t>(text->size());
  SourceLibrary sources;
  const uint32_t root = sources.add({name, std::move(text), std::nullopt, 0});
  Reporter reporter(sources, options);
  const FileFinder files(name, sources);
  SceneBuilder builder(files, reporter, origin);
  Parser(sources, files, reporter, builder).run(root);
  Reading reading{builder.finish({root, size, size}), {}};
  if (builder.is_free_to_choose_origin())
    reading.better_origin = better_origin(reading.loaded.scene);
  return reading;
}

// Where everything is far from the camera, which only shows at the end, it is read again.
LoadedScene load_text(std::shared_ptr<const std::string> text, const std::string& name,
                      const LoadOptions& options) {
  const auto stay = options.keeps_world ? std::optional(Vec3d{}) : std::nullopt;
  Reading first = read_about(stay, text, name, options);
  if (!first.better_origin) return std::move(first.loaded);
  first.loaded = {};  // not both in memory
  LoadOptions silent = options;
  silent.on_warning = {};
  return read_about(first.better_origin, std::move(text), name, silent).loaded;
}

}  // namespace

LoadedScene load_scene(const std::string& path, const LoadOptions& options) {
  std::string text;
  try {
    text = loader::read_text(path);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error("cannot read \"" + path + "\": " + error.what());
  }
  return load_text(std::make_shared<const std::string>(std::move(text)), path, options);
}

LoadedScene parse_scene(std::string_view text, const std::string& name,
                        const LoadOptions& options) {
  if (text.size() > loader::max_file_size)
    throw std::runtime_error("\"" + name + "\" is larger than 2 GiB");
  return load_text(std::make_shared<const std::string>(text), name, options);
}

}  // namespace tyndall
