// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/tyndall/commands.h"
#include "apps/tyndall/scene_info.h"
#include "apps/tyndall/scene_input.h"
#include "apps/tyndall/volume_info.h"

namespace tyndall::app {

namespace {

struct InfoArguments {
  std::vector<std::string> files;
  bool json = false;
};

bool is_scene(const std::string& path) {
  const std::filesystem::path name(path);
  return name.extension() == ".pbrt" ||
         (name.extension() == ".gz" && name.stem().extension() == ".pbrt");
}

LoadedScene load(const std::string& path) {
  return SceneInput(path, /*strict=*/false, /*quiet=*/false).load(/*keeps_world=*/true);
}

ExitCode run_info_command(const InfoArguments& arguments) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const std::string& path : arguments.files) {
    if (arguments.json)
      all.push_back(is_scene(path) ? scene_json(path, load(path))
                                   : volume_json(path, list_volume_grids(path)));
    else
      fmt::print("{}", is_scene(path) ? scene_text(path, load(path))
                                      : volume_text(path, list_volume_grids(path)));
  }
  if (arguments.json) {
    // Names need not be UTF-8.
    const auto replace = nlohmann::ordered_json::error_handler_t::replace;
    fmt::print("{}\n", all.dump(2, ' ', false, replace));
  }
  return ExitCode::done;
}

}  // namespace

void add_info_command(Program& program) {
  const auto a = std::make_shared<InfoArguments>();
  program.add_command("info", "Describe volume files and scenes")
      .positional("FILE", &a->files, "an OpenVDB, NanoVDB or pbrt-v4 scene file",
                  {.value = "", .required = true})
      .flag("--json", &a->json, "a list of objects, one for each file, for programs")
      .footer("Example:\n  tyndall info smoke.vdb\n\n" + exit_code_help())
      .on_run([a] { return run_info_command(*a); });
}

}  // namespace tyndall::app
