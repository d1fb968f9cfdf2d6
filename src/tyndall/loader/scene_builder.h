// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tyndall/loader/directives.h"
#include "tyndall/loader/files.h"
#include "tyndall/loader/graphics_state.h"
#include "tyndall/loader/load_scene.h"
#include "tyndall/loader/make_scene_parts.h"
#include "tyndall/loader/parameter_set.h"
#include "tyndall/loader/reporter.h"
#include "tyndall/loader/textures.h"
#include "tyndall/loader/tokenizer.h"

namespace tyndall::loader {

/// Carries out the directives of a scene file: one method for each. Methods throw Failure
/// if the directive cannot be carried out; the state is then as if it had not been there.
class SceneBuilder {
 public:
  /// `origin` is that of the scene's coordinates, in the file's world; where none is given,
  /// the file's option decides or, that missing, it is the camera's position.
  SceneBuilder(const FileFinder& files, Reporter& reporter, std::optional<Vec3d> origin)
      : files_(files), reporter_(reporter), wanted_origin_(origin), textures_(files) {}

  /// Called before each directive. Throws Failure if it may not stand here.
  void enter(Phase phase, const Token& directive);
  /// Where messages about the directive in hand point to.
  void set_directive(Span where) { directive_ = where; }
  /// The scene, once all is read. Names that were used before their definition are looked
  /// up here. `end` is where the scene file ends.
  LoadedScene finish(Span end);

  /// Whether neither the caller nor the file says where the origin is to be.
  bool is_free_to_choose_origin() const { return !wanted_origin_ && !coordinates_; }
  ColorSpace color_space() const { return state_.color_space; }
  ParameterSet parameter_set(const Token& directive, const std::string& name,
                             std::vector<Parameter> parameters);

  // Transformations.
  void identity();
  void concatenate(const Transform& transform);
  void set_transform(const Transform& transform);
  void coordinate_system(const std::string& name);
  void coordinate_system_transform(const std::string& name);
  void active_transform(const std::string& which);
  void transform_times();
  void reverse_orientation();

  // Before the world.
  void camera(const std::string& type, ParameterSet parameters);
  void film(const std::string& type, ParameterSet parameters);
  void pixel_filter(const std::string& type, ParameterSet parameters);
  void sampler(const std::string& type, ParameterSet parameters);
  void integrator(const std::string& type, ParameterSet parameters);
  void accelerator(const std::string& type, ParameterSet parameters);
  void option(const std::string& name, const std::string& value);
  void world_begin();
  void world_end();

  // Scopes.
  void attribute_begin();
  void attribute_end();
  void transform_begin();
  void transform_end();
  void object_begin(const std::string& name);
  void object_end();
  void begin_import();
  void end_import();

  // The world.
  void attribute(const std::string& target, std::vector<Parameter> parameters);
  void set_color_space(const std::string& name);
  void make_named_medium(const std::string& name, ParameterSet parameters);
  void medium_interface(const std::string& inside, const std::string& outside);
  void make_named_material(const std::string& name, ParameterSet parameters);
  /// A named medium or material whose definition cannot be read.
  void note_broken(bool is_medium, const std::string& name);
  void named_material(const std::string& name);
  void material(const std::string& type, ParameterSet parameters);
  void texture(const std::string& name, const std::string& kind, const std::string& type,
               ParameterSet parameters);
  void shape(const std::string& type, ParameterSet parameters);
  void object_instance(const std::string& name);
  void light_source(const std::string& type, ParameterSet parameters);
  void area_light_source(const std::string& type, ParameterSet parameters);

 private:
  enum class Scope { attribute, transform, object, import };
  struct Saved {
    Scope scope;
    GraphicsState state;
    Span where;  // of the directive that began the scope
  };
  /// A surface whose material and media are still names.
  struct PendingSurface {
    Surface surface;
    MaterialReference material;
    MediumNames media;
  };
  /// Surfaces about an origin of their own, where floats are finest for them.
  struct PendingObject {
    Vec3d origin;  // in the file's world
    std::vector<PendingSurface> surfaces;
  };
  struct PendingInstance {
    std::string object;
    Transform ctm;
    Span where;
  };

  void save(Scope scope);
  void restore(Scope scope, std::string_view begin);
  void check_transform(const Transform& transform, Span where) const;
  /// Coordinates about a point of the file's world from what is being described.
  Transform from_here(Vec3d origin) const;
  Vec3d chosen_origin() const;
  void put_origin_at(Vec3d p);
  std::vector<PendingSurface>& target_surfaces();
  void add_surface(const std::string& type, Shape shape, float alpha,
                   ParameterSet& parameters);
  void add_hidden_emitter(Shape shape);

  void check_complete(Span end);
  void check_lights(const SceneDescription& scene, Span end);
  int medium_index(const std::string& name, Span where);
  Material resolved(const MaterialReference& reference);
  Surface resolved(PendingSurface pending);
  std::vector<Surface> resolved(std::vector<PendingSurface> pending);
  Transform placed(const PendingInstance& instance, const PendingObject& object);
  std::vector<ObjectInstance> resolved_instances();
  template <typename Map>
  void miss(std::string_view kind, const std::string& name, const Map& known, Span where);
  void report_missing();

  const FileFinder& files_;
  Reporter& reporter_;
  std::optional<Vec3d> wanted_origin_;
  std::optional<std::string> coordinates_;  // what the file says of them
  Vec3d origin_;    // of the scene's coordinates, in the file's world
  Span directive_;  // the one being carried out
  bool is_in_world_ = false;
  bool is_world_missed_ = false;  // a directive of the world stood before it

  GraphicsState state_;
  std::vector<Saved> saved_;
  std::map<std::string, Transform, std::less<>> coordinate_systems_;

  RenderSettings settings_;
  std::optional<CameraRequest> camera_;
  MediumNames camera_media_;
  Span world_begin_;

  std::vector<Medium> media_;
  std::map<std::string, int, std::less<>>
      media_by_name_;  // no_medium if it is not supported
  std::map<std::string, Material, std::less<>> materials_;
  TextureTable textures_;
  std::vector<PendingSurface> surfaces_;
  std::vector<PendingObject> objects_;
  std::map<std::string, size_t, std::less<>> objects_by_name_;
  bool is_in_object_ = false;
  std::vector<PendingInstance> instances_;
  std::vector<Light> lights_;
  std::vector<HiddenEmitter> hidden_emitters_;
  std::map<std::pair<uint32_t, uint32_t>, Failure> missing_;  // names, by their places
};

}  // namespace tyndall::loader
