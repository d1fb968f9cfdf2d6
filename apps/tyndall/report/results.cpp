// SPDX-License-Identifier: Apache-2.0
#include "apps/tyndall/report/results.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "apps/tyndall/metrics_json.h"
#include "tyndall/image/whole_file.h"

namespace tyndall::app {

namespace {

using Json = nlohmann::json;

constexpr const char* format_name = "tyndall-results";
constexpr int format_version = 1;

template <typename Item>
Json array_of(const std::vector<Item>& items, Json (*convert)(const Item&)) {
  Json array = Json::array();
  for (const Item& item : items) array.push_back(convert(item));
  return array;
}

template <typename Item>
std::vector<Item> items_of(const Json& array, Item (*convert)(const Json&)) {
  std::vector<Item> items;
  for (const Json& json : array) items.push_back(convert(json));
  return items;
}

Json from_checkpoint(const Checkpoint& c) {
  return {{"seconds", c.seconds},
          {"samples_per_pixel", c.samples_per_pixel},
          {"mse", c.mse},
          {"rel_mse", c.rel_mse},
          {"rel_mse_trimmed", c.rel_mse_trimmed}};
}

Checkpoint to_checkpoint(const Json& json) {
  return {json.at("seconds"), json.at("samples_per_pixel"),
          number_from_json(json.at("mse")), number_from_json(json.at("rel_mse")),
          number_from_json(json.at("rel_mse_trimmed"))};
}

Json from_run(const Run& run) {
  return {{"seed", run.seed},
          {"seconds", run.seconds},
          {"training_seconds", run.training_seconds},
          {"cpu_seconds", run.cpu_seconds},
          {"samples_per_pixel", run.samples_per_pixel},
          {"paths", run.paths},
          {"rejected_samples", run.rejected_samples},
          {"checkpoints", array_of(run.checkpoints, from_checkpoint)},
          {"errors", to_json(run.errors)},
          {"bias", to_json(run.bias)},
          {"image", run.image},
          {"counters", run.counters},
          {"notes", run.notes},
          {"command", run.command}};
}

Run to_run(const Json& json) {
  Run run;
  run.seed = json.at("seed");
  run.seconds = json.at("seconds");
  run.training_seconds = json.at("training_seconds");
  run.cpu_seconds = json.at("cpu_seconds");
  run.samples_per_pixel = json.at("samples_per_pixel");
  run.paths = json.at("paths");
  run.rejected_samples = json.at("rejected_samples");
  run.checkpoints = items_of(json.at("checkpoints"), to_checkpoint);
  run.errors = errors_from_json(json.at("errors"));
  run.bias = bias_from_json(json.at("bias"));
  run.image = json.at("image");
  for (const auto& [name, value] : json.at("counters").items()) {
    run.counters[name] = number_from_json(value);
  }
  run.notes = json.at("notes");
  run.command = json.at("command");
  return run;
}

Json from_method(const Method& method) {
  return {{"name", method.name},
          {"integrator", method.integrator},
          {"options", method.options},
          {"runs", array_of(method.runs, from_run)}};
}

Method to_method(const Json& json) {
  Method method{json.at("name"), json.at("integrator"), {}, {}};
  json.at("options").get_to(method.options);
  method.runs = items_of(json.at("runs"), to_run);
  return method;
}

Json from_scene(const SceneResults& scene) {
  return {{"name", scene.name},
          {"path", scene.path},
          {"hash", scene.hash},
          {"width", scene.width},
          {"height", scene.height},
          {"reference", scene.reference},
          {"reference_samples_per_pixel", scene.reference_samples_per_pixel},
          {"reference_rel_mse",
           scene.reference_rel_mse ? Json(*scene.reference_rel_mse) : Json()},
          {"methods", array_of(scene.methods, from_method)}};
}

SceneResults to_scene(const Json& json) {
  SceneResults scene;
  scene.name = json.at("name");
  scene.path = json.at("path");
  scene.hash = json.at("hash");
  scene.width = json.at("width");
  scene.height = json.at("height");
  scene.reference = json.at("reference");
  scene.reference_samples_per_pixel = json.at("reference_samples_per_pixel");
  const Json& own_error = json.at("reference_rel_mse");
  if (!own_error.is_null()) scene.reference_rel_mse = own_error.get<double>();
  scene.methods = items_of(json.at("methods"), to_method);
  return scene;
}

void check_format(const Json& json) {
  if (!json.is_object() || json.value("format", "") != format_name) {
    throw std::runtime_error(
        "not a file of results: \"format\" is not \"tyndall-results\"");
  }
  if (json.at("version") != format_version) {
    throw std::runtime_error(
        fmt::format("results of version {}; this program reads version {}",
                    json.at("version").dump(), format_version));
  }
}

}  // namespace

std::string to_json(const Results& results) {
  const Machine& machine = results.machine;
  const Json json = {{"format", format_name},
                     {"version", format_version},
                     {"created", results.created},
                     {"command", results.command},
                     {"program", results.program},
                     {"commit", results.commit},
                     {"compiler", results.compiler},
                     {"flags", results.flags},
                     {"machine",
                      {{"cpu", machine.cpu},
                       {"system", machine.system},
                       {"cores", machine.cores},
                       {"memory_bytes", machine.memory_bytes}}},
                     {"threads", results.threads},
                     {"time_limit", results.time_limit},
                     {"epsilon", results.epsilon},
                     {"scenes", array_of(results.scenes, from_scene)}};
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

Results results_from_json(const std::string& text) {
  try {
    const Json json = Json::parse(text);
    check_format(json);
    Results results;
    results.created = json.at("created");
    results.command = json.at("command");
    results.program = json.at("program");
    results.commit = json.at("commit");
    results.compiler = json.at("compiler");
    results.flags = json.at("flags");
    const Json& machine = json.at("machine");
    results.machine = {machine.at("cpu"), machine.at("system"), machine.at("cores"),
                       machine.at("memory_bytes")};
    results.threads = json.at("threads");
    results.time_limit = json.at("time_limit");
    results.epsilon = json.at("epsilon");
    results.scenes = items_of(json.at("scenes"), to_scene);
    return results;
  } catch (const Json::exception& error) {
    throw std::runtime_error(fmt::format("not a file of results: {}", error.what()));
  }
}

Results read_results(const std::string& path) {
  const std::string text = read_whole_file(path);
  try {
    return results_from_json(text);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(fmt::format("{}: {}", path, error.what()));
  }
}

}  // namespace tyndall::app
