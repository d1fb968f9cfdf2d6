// SPDX-License-Identifier: Apache-2.0
#include "tyndall/loader/directives.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "tyndall/loader/parser.h"
#include "tyndall/loader/scene_builder.h"

namespace tyndall::loader {
namespace {

// `Camera "perspective" parameters...`; the builder's method takes both.
template <void (SceneBuilder::*method)(const std::string&, ParameterSet)>
void typed(Parser& in, SceneBuilder& scene) {
  const std::string type = in.string("a type");
  const Token directive = in.directive();
  (scene.*method)(type, scene.parameter_set(directive, type, in.parameters()));
}

template <void (SceneBuilder::*method)()>
void plain(Parser&, SceneBuilder& scene) {
  (scene.*method)();
}

template <void (SceneBuilder::*method)(const std::string&)>
void named(Parser& in, SceneBuilder& scene) {
  (scene.*method)(in.string("a name"));
}

void translate(Parser& in, SceneBuilder& scene) {
  const auto [x, y, z] = in.numbers<3>();
  scene.concatenate(Transform::translate({x, y, z}));
}

void scale(Parser& in, SceneBuilder& scene) {
  const auto [x, y, z] = in.numbers<3>();
  if (x == 0 || y == 0 || z == 0)
    fail(in.directive().where,
         fmt::format("Scale by zero flattens everything, got {} {} {}", x, y, z));
  scene.concatenate(Transform::scale({x, y, z}));
}

void rotate(Parser& in, SceneBuilder& scene) {
  const auto [angle, x, y, z] = in.numbers<4>();
  const double size = length(Vec3d{x, y, z});
  if (!(size > 0) || !std::isfinite(size))
    fail(in.directive().where, fmt::format("Rotate needs an axis, got {} {} {}", x, y, z));
  scene.concatenate(Transform::rotate(angle, {x, y, z}));
}

void look_at(Parser& in, SceneBuilder& scene) {
  const std::array<double, 9> v = in.numbers<9>();
  const auto transform =
      Transform::look_at({v[0], v[1], v[2]}, {v[3], v[4], v[5]}, {v[6], v[7], v[8]});
  if (!transform)
    fail(in.directive().where,
         "LookAt: the direction of view is zero or parallel to the up vector");
  scene.concatenate(*transform);
}

Transform matrix(Parser& in) {
  const std::array<double, 16> v = in.numbers<16>();
  Matrix4 m{};  // the file holds columns
  for (size_t i = 0; i < 16; ++i) m[i % 4][i / 4] = v[i];
  const auto transform = Transform::from_matrix(m);
  if (!transform)
    fail(in.directive().where,
         fmt::format("{}: the matrix cannot be inverted", in.directive().text));
  return *transform;
}

void medium_interface(Parser& in, SceneBuilder& scene) {
  const std::string inside = in.string("a medium name");
  const std::string outside = in.optional_string().value_or(inside);
  scene.medium_interface(inside, outside);
}

// One whose parameters cannot be read is there all the same: that its name is used is no
// error of its own.
void make_named(Parser& in, SceneBuilder& scene) {
  const std::string name = in.string("a name");
  const Token directive = in.directive();
  const bool is_medium = directive.text == "MakeNamedMedium";
  std::vector<Parameter> list;
  try {
    list = in.parameters();
  } catch (const Failure&) {
    scene.note_broken(is_medium, name);
    throw;
  }
  ParameterSet parameters = scene.parameter_set(directive, name, std::move(list));
  if (is_medium)
    scene.make_named_medium(name, std::move(parameters));
  else
    scene.make_named_material(name, std::move(parameters));
}

void texture(Parser& in, SceneBuilder& scene) {
  const std::string name = in.string("a name");
  const std::string kind = in.string("\"float\" or \"spectrum\"");
  const std::string type = in.string("a type");
  const Token directive = in.directive();
  scene.texture(name, kind, type, scene.parameter_set(directive, name, in.parameters()));
}

void attribute(Parser& in, SceneBuilder& scene) {
  const std::string target = in.string("a target");
  scene.attribute(target, in.parameters());
}

void option(Parser& in, SceneBuilder& scene) {
  const std::string name = in.string("a name");
  scene.option(name, in.value());
}

void include(Parser& in, SceneBuilder&) {
  const std::string name = in.string("a file name");
  in.include(name, in.directive().where, in.directive().text == "Import");
}

void active_transform(Parser& in, SceneBuilder& scene) {
  scene.active_transform(in.value());
}

void transform_times(Parser& in, SceneBuilder& scene) {
  in.numbers<2>();
  scene.transform_times();
}

using S = SceneBuilder;
constexpr std::array directives{
    Directive{"Identity", Phase::anywhere, plain<&S::identity>},
    Directive{"Translate", Phase::anywhere, translate},
    Directive{"Scale", Phase::anywhere, scale},
    Directive{"Rotate", Phase::anywhere, rotate},
    Directive{"LookAt", Phase::anywhere, look_at},
    Directive{"Transform", Phase::anywhere,
              [](Parser& in, S& scene) { scene.set_transform(matrix(in)); }},
    Directive{"ConcatTransform", Phase::anywhere,
              [](Parser& in, S& scene) { scene.concatenate(matrix(in)); }},
    Directive{"CoordinateSystem", Phase::anywhere, named<&S::coordinate_system>},
    Directive{"CoordSysTransform", Phase::anywhere, named<&S::coordinate_system_transform>},
    Directive{"ActiveTransform", Phase::anywhere, active_transform},
    Directive{"TransformTimes", Phase::before_world, transform_times},
    Directive{"ReverseOrientation", Phase::anywhere, plain<&S::reverse_orientation>},
    Directive{"ColorSpace", Phase::anywhere, named<&S::set_color_space>},
    Directive{"Attribute", Phase::anywhere, attribute},
    Directive{"Option", Phase::before_world, option},
    Directive{"Include", Phase::anywhere, include},
    Directive{"Import", Phase::in_world, include},
    Directive{"Camera", Phase::before_world, typed<&S::camera>},
    Directive{"Film", Phase::before_world, typed<&S::film>},
    Directive{"PixelFilter", Phase::before_world, typed<&S::pixel_filter>},
    Directive{"Sampler", Phase::before_world, typed<&S::sampler>},
    Directive{"Integrator", Phase::before_world, typed<&S::integrator>},
    Directive{"Accelerator", Phase::before_world, typed<&S::accelerator>},
    Directive{"WorldBegin", Phase::before_world, plain<&S::world_begin>},
    Directive{"WorldEnd", Phase::in_world, plain<&S::world_end>},
    Directive{"AttributeBegin", Phase::in_world, plain<&S::attribute_begin>},
    Directive{"AttributeEnd", Phase::in_world, plain<&S::attribute_end>},
    Directive{"TransformBegin", Phase::in_world, plain<&S::transform_begin>},
    Directive{"TransformEnd", Phase::in_world, plain<&S::transform_end>},
    Directive{"ObjectBegin", Phase::in_world, named<&S::object_begin>},
    Directive{"ObjectEnd", Phase::in_world, plain<&S::object_end>},
    Directive{"ObjectInstance", Phase::in_world, named<&S::object_instance>},
    Directive{"MakeNamedMedium", Phase::anywhere, make_named},
    Directive{"MediumInterface", Phase::anywhere, medium_interface},
    Directive{"MakeNamedMaterial", Phase::in_world, make_named},
    Directive{"NamedMaterial", Phase::in_world, named<&S::named_material>},
    Directive{"Material", Phase::in_world, typed<&S::material>},
    Directive{"Texture", Phase::in_world, texture},
    Directive{"Shape", Phase::in_world, typed<&S::shape>},
    Directive{"LightSource", Phase::in_world, typed<&S::light_source>},
    Directive{"AreaLightSource", Phase::in_world, typed<&S::area_light_source>},
};

}  // namespace

const Directive* find_directive(std::string_view name) {
  const auto found = std::find_if(directives.begin(), directives.end(),
                                  [&](const Directive& d) { return d.name == name; });
  return found == directives.end() ? nullptr : &*found;
}

std::vector<std::string_view> directive_names() {
  std::vector<std::string_view> names;
  names.reserve(std::size(directives));
  for (const Directive& directive : directives) names.push_back(directive.name);
  return names;
}

}  // namespace tyndall::loader
