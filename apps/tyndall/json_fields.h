// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <concepts>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

/// Structs as JSON objects. A struct names its members once, for writing and reading:
///   void fields(auto& archive, Of<Point> auto& p) { archive("x", p.x); archive("y", p.y);
///   }
/// Infinities and NaN become null, which is read back as NaN.
namespace tyndall::app {

/// T or const T.
template <typename Argument, typename T>
concept Of = std::same_as<std::remove_const_t<Argument>, T>;

template <typename T>
nlohmann::json write_json(const T& value);
template <typename T>
void read_json(const nlohmann::json& json, const std::string& path, T& value);
template <typename T>
nlohmann::json write_json(const std::vector<T>& values);
template <typename T>
nlohmann::json write_json(const std::optional<T>& value);
template <typename T>
void read_json(const nlohmann::json& json, const std::string& path, std::vector<T>& values);
template <typename T>
void read_json(const nlohmann::json& json, const std::string& path,
               std::optional<T>& value);
template <typename T>
void read_json(const nlohmann::json& json, const std::string& path,
               std::map<std::string, T>& values);

/// Collects the members of an object.
struct JsonWriter {
  nlohmann::json object = nlohmann::json::object();

  template <typename T>
  void operator()(const char* name, const T& value) {
    object[name] = write_json(value);
  }
};

/// Takes the members out of an object; optional ones may be missing. `path` says where it
/// stands, for messages.
struct JsonReader {
  const nlohmann::json& object;
  std::string path;

  template <typename T>
  void operator()(const char* name, T& value) const {
    const std::string place = path.empty() ? name : path + "." + name;
    const auto found = object.find(name);
    if (found != object.end()) return read_json(*found, place, value);
    if constexpr (requires { value.reset(); })
      value.reset();
    else
      throw std::runtime_error(place + " is missing");
  }
};

template <typename T>
concept HasFields = requires(JsonWriter writer, const T& value) {
  fields(writer, value);
};

template <typename T>
nlohmann::json write_json(const std::vector<T>& values) {
  nlohmann::json array = nlohmann::json::array();
  for (const T& value : values) array.push_back(write_json(value));
  return array;
}

template <typename T>
nlohmann::json write_json(const std::optional<T>& value) {
  return value ? write_json(*value) : nlohmann::json();
}

template <typename T>
nlohmann::json write_json(const T& value) {
  if constexpr (HasFields<T>) {
    JsonWriter writer;
    fields(writer, value);
    return writer.object;
  } else {
    return value;
  }
}

/// Throws std::runtime_error unless the value is what is wanted.
inline void require_json(bool is_wanted, const nlohmann::json& json,
                         const std::string& path, const char* wanted) {
  if (is_wanted) return;
  throw std::runtime_error(
      fmt::format("{} must be {}, not {}", path, wanted, json.type_name()));
}

template <typename T>
void read_json(const nlohmann::json& json, const std::string& path,
               std::vector<T>& values) {
  require_json(json.is_array(), json, path, "an array");
  values.clear();
  for (const nlohmann::json& item : json) {
    const std::string place = fmt::format("{}[{}]", path, values.size());
    read_json(item, place, values.emplace_back());
  }
}

template <typename T>
void read_json(const nlohmann::json& json, const std::string& path,
               std::map<std::string, T>& values) {
  require_json(json.is_object(), json, path, "an object");
  values.clear();
  for (const auto& [name, item] : json.items())
    read_json(item, path + "." + name, values[name]);
}

template <typename T>
void read_json(const nlohmann::json& json, const std::string& path,
               std::optional<T>& value) {
  if (json.is_null())
    value.reset();
  else
    read_json(json, path, value.emplace());
}

template <typename T>
void read_json(const nlohmann::json& json, const std::string& path, T& value) {
  if constexpr (HasFields<T>) {
    require_json(json.is_object(), json, path, "an object");
    JsonReader reader{json, path};
    fields(reader, value);
  } else if constexpr (std::same_as<T, std::string>) {
    require_json(json.is_string(), json, path, "text");
    value = json.get<std::string>();
  } else if constexpr (std::same_as<T, bool>) {
    require_json(json.is_boolean(), json, path, "true or false");
    value = json.get<bool>();
  } else if constexpr (std::floating_point<T>) {
    require_json(json.is_number() || json.is_null(), json, path, "a number");
    value = json.is_null() ? std::numeric_limits<T>::quiet_NaN() : json.get<T>();
  } else {
    require_json(json.is_number(), json, path, "a number");
    value = json.get<T>();
  }
}

}  // namespace tyndall::app
