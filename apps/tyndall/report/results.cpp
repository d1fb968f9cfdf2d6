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

}  // namespace

void fields(auto& archive, Of<Checkpoint> auto& c) {
  archive("seconds", c.seconds);
  archive("samples_per_pixel", c.samples_per_pixel);
  archive("mse", c.mse);
  archive("rel_mse", c.rel_mse);
  archive("rel_mse_trimmed", c.rel_mse_trimmed);
}

void fields(auto& archive, Of<Run> auto& run) {
  archive("seed", run.seed);
  archive("seconds", run.seconds);
  archive("training_seconds", run.training_seconds);
  archive("cpu_seconds", run.cpu_seconds);
  archive("samples_per_pixel", run.samples_per_pixel);
  archive("paths", run.paths);
  archive("rejected_samples", run.rejected_samples);
  archive("peak_memory_bytes", run.peak_memory_bytes);
  archive("checkpoints", run.checkpoints);
  archive("errors", run.errors);
  archive("bias", run.bias);
  archive("image", run.image);
  archive("counters", run.counters);
  archive("notes", run.notes);
  archive("command", run.command);
}

void fields(auto& archive, Of<Method> auto& method) {
  archive("name", method.name);
  archive("integrator", method.integrator);
  archive("options", method.options);
  archive("runs", method.runs);
}

void fields(auto& archive, Of<SceneResults> auto& scene) {
  archive("name", scene.name);
  archive("path", scene.path);
  archive("hash", scene.hash);
  archive("width", scene.width);
  archive("height", scene.height);
  archive("reference", scene.reference);
  archive("reference_samples_per_pixel", scene.reference_samples_per_pixel);
  archive("reference_rel_mse", scene.reference_rel_mse);
  archive("methods", scene.methods);
}

void fields(auto& archive, Of<Machine> auto& machine) {
  archive("cpu", machine.cpu);
  archive("system", machine.system);
  archive("cores", machine.cores);
  archive("memory_bytes", machine.memory_bytes);
}

void fields(auto& archive, Of<Results> auto& results) {
  archive("created", results.created);
  archive("command", results.command);
  archive("program", results.program);
  archive("commit", results.commit);
  archive("compiler", results.compiler);
  archive("flags", results.flags);
  archive("machine", results.machine);
  archive("threads", results.threads);
  archive("time_limit", results.time_limit);
  archive("epsilon", results.epsilon);
  archive("scenes", results.scenes);
}

namespace {

void check_format(const Json& json) {
  if (!json.is_object() || json.value("format", Json()) != format_name) {
    throw std::runtime_error("\"format\" is not \"tyndall-results\"");
  }
  int version = 0;
  JsonReader{json, ""}("version", version);
  if (version != format_version) {
    throw std::runtime_error(fmt::format("it has version {}, this program reads version {}",
                                         version, format_version));
  }
}

/// What a parser has to say, without the number of its kind.
std::string parse_message(const Json::exception& error) {
  const std::string text = error.what();
  const size_t end = text.find("] ");
  return end == std::string::npos ? text : text.substr(end + 2);
}

}  // namespace

std::string to_json(const Results& results) {
  Json json = write_json(results);
  json["format"] = format_name;
  json["version"] = format_version;
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

Results results_from_json(const std::string& text) {
  try {
    const Json json = Json::parse(text);
    check_format(json);
    Results results;
    read_json(json, "", results);
    return results;
  } catch (const Json::exception& error) {
    throw std::runtime_error("not a file of results: " + parse_message(error));
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(std::string("not a file of results: ") + error.what());
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
