// SPDX-License-Identifier: Apache-2.0
#include "apps/tyndall/bench/bench_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <sstream>
#include <stdexcept>

#include "apps/tyndall/exit_code.h"
#include "apps/tyndall/nearest_name.h"
#include "tyndall/image/whole_file.h"
#include "tyndall/integrators/render.h"

namespace tyndall::app {

namespace {

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

void check_integrator(const std::string& name) {
  const std::vector<std::string> names = integrator_names();
  if (std::find(names.begin(), names.end(), name) != names.end()) return;
  const std::string nearest = nearest_name(name, names);
  throw std::invalid_argument(
      fmt::format("must be integrators separated by commas; there is no '{}'; {}", name,
                  nearest.empty() ? fmt::format("there are {}", fmt::join(names, ", "))
                                  : fmt::format("did you mean {}?", nearest)));
}

Method parse_method(const std::string& text) {
  const std::vector<std::string> parts = split(text, ':');
  Method method{text, parts.empty() ? "" : parts.front(), {}, {}};
  check_integrator(method.integrator);
  for (size_t i = 1; i < parts.size(); ++i)
    method.options.insert(parse_assignment(parts[i]));
  return method;
}

bool are_unique(const std::vector<std::string>& names) {
  return std::set(names.begin(), names.end()).size() == names.size();
}

}  // namespace

std::vector<Method> parse_methods(const std::string& text) {
  std::vector<Method> methods;
  std::vector<std::string> names = split(text, ',');
  if (names.empty()) names = {""};
  methods.reserve(names.size());
  for (const std::string& name : names) methods.push_back(parse_method(name));
  if (!are_unique(names)) throw std::invalid_argument("must not name a method twice");
  return methods;
}

std::vector<std::string> scene_names(const std::vector<std::string>& paths) {
  std::vector<std::string> short_names, long_names;
  for (const std::string& path : paths) {
    const auto absolute = std::filesystem::absolute(path);
    const std::string stem = absolute.stem().string(),
                      folder = absolute.parent_path().filename().string();
    short_names.push_back(stem == "scene" ? folder : stem);
    long_names.push_back(fmt::format("{}-{}", folder, stem));
  }
  if (are_unique(short_names)) return short_names;
  if (!are_unique(long_names)) {
    throw UsageError("two scenes have the same name; measure them with separate commands");
  }
  return long_names;
}

void check_plan(const BenchPlan& plan) {
  if (plan.reference && plan.make_reference) {
    throw UsageError("--reference and --make-reference exclude each other");
  }
  if (plan.reference && plan.scenes.size() > 1) {
    throw UsageError("--reference serves one scene; use --make-reference for several");
  }
  if (!(plan.epsilon > 0)) {
    throw UsageError(fmt::format("--epsilon must be above 0, got {:g}", plan.epsilon));
  }
}

std::string file_hash(const std::string& path) {
  uint64_t hash = 0xcbf29ce484222325;
  for (const char c : read_whole_file(path)) {
    hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  }
  return fmt::format("{:016x}", hash);
}

}  // namespace tyndall::app
