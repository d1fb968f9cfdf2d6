// SPDX-License-Identifier: Apache-2.0
#include "apps/tyndall/bench/bench_store.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <thread>

#include "apps/tyndall/bench/build_info.h"
#include "apps/tyndall/exit_code.h"
#include "apps/tyndall/version.h"
#include "tyndall/image/whole_file.h"

namespace tyndall::app {

namespace {

Results empty_results(const BenchPlan& plan, const std::string& command_line) {
  Results results;
  results.created = utc_now();
  results.command = command_line;
  results.program = version_name();
  results.commit = build_commit();
  results.compiler = build_compiler();
  results.flags = build_flags();
  results.machine = this_machine();
  results.threads = plan.render.threads > 0
                        ? plan.render.threads
                        : static_cast<int>(std::thread::hardware_concurrency());
  results.time_limit = plan.time_limit;
  results.epsilon = plan.epsilon;
  return results;
}

void make_folder(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    throw OutputError(
        fmt::format("{}: cannot make the folder: {}", folder, error.message()));
  }
}

void write(const std::string& path, const std::string& text) {
  try {
    write_whole_file(path, text);
  } catch (const std::runtime_error& error) {
    throw OutputError(error.what());
  }
}

[[noreturn]] void refuse(const std::string& path, const std::string& what,
                         const std::string& before, const std::string& now) {
  throw UsageError(
      fmt::format("{} was measured with {} {}, now it is {}; give another --output", path,
                  what, before, now));
}

}  // namespace

BenchStore::BenchStore(const BenchPlan& plan, const std::string& command_line)
    : folder_(plan.folder) {
  make_folder(folder_);
  const std::string file = path("results.json");
  results_ = empty_results(plan, command_line);
  if (std::filesystem::exists(file)) {
    const Results now = results_;
    results_ = read_results(file);
    check_conditions(plan);
    results_.command = now.command;
  } else {
    save();
  }
}

void BenchStore::check_conditions(const BenchPlan& plan) const {
  const std::string file = path("results.json");
  const Results now = empty_results(plan, "");
  const auto check = [&](const char* what, const auto& before, const auto& current) {
    if (before != current) {
      refuse(file, what, fmt::format("{}", before), fmt::format("{}", current));
    }
  };
  check("commit", results_.commit, now.commit);
  check("time limit", results_.time_limit, now.time_limit);
  check("epsilon", results_.epsilon, now.epsilon);
  check("threads", results_.threads, now.threads);
  check("processor", results_.machine.cpu, now.machine.cpu);
}

std::string BenchStore::path(const std::string& file) const {
  return (std::filesystem::path(folder_) / file).string();
}

SceneResults& BenchStore::scene(const SceneResults& wanted) {
  auto found = std::find_if(results_.scenes.begin(), results_.scenes.end(),
                            [&](const SceneResults& s) { return s.name == wanted.name; });
  if (found == results_.scenes.end()) return results_.scenes.emplace_back(wanted);
  const std::string file = path("results.json") + ": scene " + wanted.name;
  if (found->hash != wanted.hash) refuse(file, "contents", found->hash, wanted.hash);
  if (found->width != wanted.width || found->height != wanted.height) {
    refuse(file, "size", fmt::format("{}x{}", found->width, found->height),
           fmt::format("{}x{}", wanted.width, wanted.height));
  }
  if (found->reference != wanted.reference) {
    refuse(file, "reference", found->reference, wanted.reference);
  }
  return *found;
}

Method& BenchStore::method(SceneResults& scene, const Method& wanted) {
  const auto found = std::find_if(scene.methods.begin(), scene.methods.end(),
                                  [&](const Method& m) { return m.name == wanted.name; });
  return found != scene.methods.end() ? *found : scene.methods.emplace_back(wanted);
}

bool BenchStore::has_run(const Method& method, uint64_t seed) const {
  return std::any_of(method.runs.begin(), method.runs.end(),
                     [&](const Run& run) { return run.seed == seed; });
}

void BenchStore::save() { write(path("results.json"), to_json(results_)); }

}  // namespace tyndall::app
