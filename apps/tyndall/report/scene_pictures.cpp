// SPDX-License-Identifier: Apache-2.0
#include "apps/tyndall/report/scene_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "apps/tyndall/report/html_text.h"
#include "apps/tyndall/report/picture_code.h"
#include "tyndall/image/flip.h"
#include "tyndall/image/io.h"
#include "tyndall/image/metrics.h"

namespace tyndall::app {

namespace {

Image read_color(const std::string& folder, const std::string& name) {
  const std::string path = (std::filesystem::path(folder) / name).string();
  Image image = read_image(path);
  if (!image.has_rgb()) {
    throw std::runtime_error(fmt::format("{}: the image has no R, G and B channels", path));
  }
  return image;
}

/// Zero for a picture of usual brightness; otherwise what makes its mean a middle grey, in
/// quarter stops.
float choose_exposure(const Image& reference) {
  const RgbPlanes planes = reference.rgb_planes();
  double sum = 0;
  size_t count = 0;
  for (size_t i = 0; i < reference.pixel_count(); ++i) {
    const float y = luminance(planes[i]);
    if (!std::isfinite(y)) continue;
    sum += std::clamp(double{y}, 0.0, 4.0);
    ++count;
  }
  const double mean = count > 0 ? sum / static_cast<double>(count) : 0;
  if (mean <= 0 || (mean > 0.03 && mean < 0.6)) return 0;
  return static_cast<float>(std::round(4 * std::log2(0.18 / mean)) / 4);
}

std::string data_element(const std::string& id, const std::string& bytes) {
  return fmt::format("<script type=\"text/plain\" id=\"{}\">{}</script>\n", id,
                     base64(bytes));
}

}  // namespace

ScenePictures read_pictures(const SceneResults& scene, const std::string& folder) {
  ScenePictures result;
  result.pictures.push_back({"reference", read_color(folder, scene.reference), {}});
  const Image reference = result.pictures[0].image;
  for (const Method& method : scene.methods) {
    if (method.runs.empty()) continue;
    const std::string& file = method.runs.front().image;
    ScenePicture picture{method.name, read_color(folder, file), {}};
    try {
      check_comparable(picture.image, reference);
    } catch (const std::invalid_argument& error) {
      throw std::runtime_error(fmt::format("{}: {}", file, error.what()));
    }
    result.pictures.push_back(std::move(picture));
  }
  std::vector<const Image*> images;
  for (size_t i = 1; i < result.pictures.size(); ++i) {
    images.push_back(&result.pictures[i].image);
  }
  std::vector<std::vector<float>> maps = hdr_flip(images, reference);
  for (size_t i = 0; i < maps.size(); ++i) result.pictures[i + 1].flip = std::move(maps[i]);
  result.exposure = choose_exposure(reference);
  result.insets = choose_insets(images, reference, 3);
  return result;
}

PackedPictures pack_pictures(const ScenePictures& pictures, double epsilon, int steps,
                             int number) {
  const Image& reference = pictures.pictures.front().image;
  const LevelScale scale = choose_scale(reference, steps);
  PackedPictures packed;
  nlohmann::json list = nlohmann::json::array();
  for (const ScenePicture& picture : pictures.pictures) {
    const std::string id = fmt::format("p{}-{}", number, list.size());
    packed.data += data_element(id, encode_picture(picture.image, scale));
    nlohmann::json entry = {{"name", picture.name}, {"data", id}};
    if (!picture.flip.empty()) {
      entry["flip"] = id + "f";
      packed.data += data_element(id + "f", encode_map(picture.flip, reference.width()));
    }
    list.push_back(entry);
  }
  const nlohmann::json description = {
      {"width", reference.width()},   {"height", reference.height()},
      {"floor", scale.floor},         {"steps", scale.steps},
      {"epsilon", epsilon},           {"pictures", list},
      {"exposure", pictures.exposure}};
  packed.description =
      description.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
  return packed;
}

}  // namespace tyndall::app
