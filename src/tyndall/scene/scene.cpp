// SPDX-License-Identifier: Apache-2.0
#include "tyndall/scene/scene.h"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include "tyndall/sampling/tabulated.h"
#include "tyndall/scene/boundary_check.h"
#include "tyndall/scene/boundary_steps.h"
#include "tyndall/scene/camera_medium.h"
#include "tyndall/scene/glow.h"
#include "tyndall/scene/medium_sets.h"

namespace tyndall {
namespace {

constexpr size_t no_light = std::numeric_limits<size_t>::max();

bool is_boundary(const Surface& surface) {
  return std::holds_alternative<InterfaceBsdf>(surface.material);
}

Intersector::Group make_group(const std::vector<Surface>& surfaces) {
  Intersector::Group group;
  group.reserve(surfaces.size());
  for (const Surface& surface : surfaces)
    group.push_back({&surface.shape, is_boundary(surface), surface.alpha});
  return group;
}

std::vector<Intersector::Group> make_groups(const SceneDescription& description) {
  std::vector<Intersector::Group> groups{make_group(description.surfaces)};
  for (const std::vector<Surface>& object : description.objects)
    groups.push_back(make_group(object));
  return groups;
}

std::vector<Intersector::Instance> make_instances(const SceneDescription& description) {
  std::vector<Intersector::Instance> instances;
  for (const ObjectInstance& instance : description.instances)
    instances.push_back(
        {static_cast<uint32_t>(instance.object + 1), instance.world_from_object});
  return instances;
}

bool any_boundary(const SceneDescription& description) {
  bool any = std::ranges::any_of(description.surfaces, is_boundary);
  for (const std::vector<Surface>& object : description.objects)
    any = any || std::ranges::any_of(object, is_boundary);
  return any;
}

Light area_light(const Surface& surface, Rgb L) {
  return Light(
      AreaLight{.shape = &surface.shape, .L = L, .two_sided = surface.emission->two_sided});
}

}  // namespace

class Scene::Impl {
 public:
  explicit Impl(SceneDescription d)
      : description(std::move(d)),
        intersector(make_groups(description), make_instances(description)),
        sets(description.media),
        has_boundaries(any_boundary(description)),
        bounds(intersector.bounds()),
        lights(description.lights) {
    bounds.extend(description.camera.position());
    add_area_lights();
    add_volume_light();
    measure_power();
  }

  const Surface& surface(uint32_t group, uint32_t shape) const {
    const std::vector<Surface>& surfaces =
        group == 0 ? description.surfaces : description.objects[group - 1];
    return surfaces[shape];
  }

  SurfaceHit resolve(const Ray& ray, const RayHit& hit) const {
    const size_t light = hit.group == 0 ? light_of_surface[hit.shape] : no_light;
    return {.t = hit.t,
            .point = intersector.resolve(ray, hit).point,
            .surface = &surface(hit.group, hit.shape),
            .light = light == no_light ? nullptr : seen_light(light),
            .light_index = light};
  }

  // A lamp as a ray sees it that has met it.
  const Light* seen_light(size_t light) const {
    const auto found = met_lights.find(light);
    return found == met_lights.end() ? &lights[light] : &found->second;
  }

  std::optional<SurfaceHit> intersect(const Ray& ray, float t_max, RayMask mask) const {
    const std::optional<RayHit> hit = intersector.find(ray, t_max, mask);
    return hit ? std::optional<SurfaceHit>(resolve(ray, *hit)) : std::nullopt;
  }

  SurfaceCrossing resolve(const Crossing& crossing) const {
    return {.t = crossing.t,
            .surface = &surface(crossing.group, crossing.shape),
            .goes_out = crossing.goes_out};
  }

  // Cuts (0, t_end) of a ray at the boundaries that it goes through. Returns the medium at
  // the end.
  const Medium* cut(const Ray& ray, float t_end, const Medium* medium,
                    const Crossings& crossings, MediumSpans& spans) const {
    if (crossings.empty()) {
      spans.push_back({0, t_end, medium});
      return medium;
    }
    BoundarySteps steps(ray, t_end);
    for (const Crossing& crossing : crossings) steps.add(resolve(crossing));
    float t = 0;
    const auto is_in = [&](int index) {
      return sets.contains(medium, this->medium(index));
    };
    while (const BoundaryStep* step = steps.next(is_in)) {
      const Medium* behind =
          sets.cross(medium, this->medium(step->from), this->medium(step->to));
      if (behind == medium) continue;
      if (step->t > t) spans.push_back({t, step->t, medium});
      t = std::max(t, step->t);
      medium = behind;
    }
    if (t_end > t || spans.empty()) spans.push_back({t, t_end, medium});
    return medium;
  }

  const Medium* medium(int index) const {
    return index == no_medium ? nullptr : &description.media[static_cast<size_t>(index)];
  }

  // All of them at once.
  const Medium* medium_of(const std::vector<int>& media) const {
    const Medium* all = nullptr;
    for (const int index : media) all = sets.cross(all, nullptr, medium(index));
    return all;
  }

  SceneDescription description;
  Intersector intersector;
  MediumSets sets;
  bool has_boundaries;
  Bounds3 bounds;
  std::vector<Light> lights;
  std::map<size_t, Light> met_lights;    // those that alpha dims, undimmed
  std::vector<size_t> environments;      // indices of lights that rays can escape to
  std::vector<size_t> light_of_surface;  // or no_light
  std::optional<size_t> volume_light;    // index
  bool has_glow = false;
  DiscreteDistribution light_power;
  const Medium* camera_medium = nullptr;
  std::vector<int> camera_media;
  std::vector<std::string> remarks;

 private:
  void add_area_lights() {
    light_of_surface.assign(description.surfaces.size(), no_light);
    for (size_t i = 0; i < description.surfaces.size(); ++i) {
      const Surface& surface = description.surfaces[i];
      if (!surface.emission || is_black(surface.emission->L)) continue;
      light_of_surface[i] = lights.size();
      const Rgb L = surface.emission->L;
      if (surface.alpha < 1) met_lights.emplace(lights.size(), area_light(surface, L));
      lights.push_back(area_light(surface, L * surface.alpha));
    }
    for (const HiddenEmitter& hidden : description.hidden_emitters)
      if (!is_black(hidden.emission.L))
        lights.emplace_back(HiddenAreaLight{{.shape = &hidden.shape,
                                             .L = hidden.emission.L,
                                             .two_sided = hidden.emission.two_sided}});
    for (const std::vector<Surface>& object : description.objects)
      for (const Surface& surface : object)
        if (surface.emission)
          remarks.push_back(
              surface.name +
              ": area lights inside objects are not supported: it emits nothing");
  }

  void add_volume_light() {
    has_glow = std::ranges::any_of(description.media, &Medium::is_emissive);
    std::optional<VolumeLight> light = make_volume_light(description);
    if (!light) return;
    volume_light = lights.size();
    lights.emplace_back(std::move(*light));
  }

  void measure_power() {
    std::vector<float> power;
    for (size_t i = 0; i < lights.size(); ++i) {
      power.push_back(luminance(lights[i].power(bounds.radius())));
      if (lights[i].is_environment()) environments.push_back(i);
    }
    light_power = DiscreteDistribution(power);
  }
};

Scene::Scene(SceneDescription description)
    : impl_(std::make_unique<Impl>(std::move(description))) {
  const CameraMediumFinding finding =
      find_camera_medium(*this, impl_->description.camera_medium);
  impl_->camera_medium = impl_->medium_of(finding.media);
  impl_->camera_media = finding.media;
  const auto check = [&](const std::vector<Surface>& surfaces) {
    for (std::string& remark : check_boundaries(surfaces))
      impl_->remarks.push_back(std::move(remark));
  };
  check(impl_->description.surfaces);
  for (const std::vector<Surface>& object : impl_->description.objects) check(object);
  if (!finding.remark.empty()) impl_->remarks.push_back(finding.remark);
}

Scene::~Scene() = default;

const PerspectiveCamera& Scene::camera() const { return impl_->description.camera; }
const Medium* Scene::camera_medium() const { return impl_->camera_medium; }
const std::vector<int>& Scene::camera_media() const { return impl_->camera_media; }
const std::vector<Light>& Scene::lights() const { return impl_->lights; }
Bounds3 Scene::bounds() const { return impl_->bounds; }
std::optional<size_t> Scene::volume_light() const { return impl_->volume_light; }
bool Scene::has_glow() const { return impl_->has_glow; }
bool Scene::has_boundaries() const { return impl_->has_boundaries; }

const Medium* Scene::surrounding_medium(Vec3 p) const {
  std::vector<int> otherwise;
  if (impl_->description.camera_medium != no_medium)
    otherwise.push_back(impl_->description.camera_medium);
  return impl_->medium_of(find_media(*this, p, otherwise).media);
}

const Medium* Scene::medium_at_infinity(Vec3 w) const {
  MediumSpans spans;
  return media_along({camera().position(), w}, infinity, camera_medium(), spans);
}

const Medium* Scene::filling_medium() const {
  return has_boundaries() ? nullptr : camera_medium();
}
const std::vector<std::string>& Scene::remarks() const { return impl_->remarks; }
const SceneDescription& Scene::description() const { return impl_->description; }

std::optional<SurfaceHit> Scene::intersect(const Ray& ray, float t_max) const {
  return impl_->intersect(ray, t_max, RayMask::all);
}

std::optional<FoundSurface> Scene::find(const Ray& ray, float t_max) const {
  const std::optional<RayHit> hit = impl_->intersector.find(ray, t_max, RayMask::all);
  if (!hit) return std::nullopt;
  return FoundSurface{*hit, &impl_->surface(hit->group, hit->shape)};
}

SurfaceHit Scene::resolve(const Ray& ray, const FoundSurface& found) const {
  return impl_->resolve(ray, found.hit);
}

std::optional<SurfaceHit> Scene::intersect_opaque(const Ray& ray, float t_max) const {
  return impl_->intersect(ray, t_max, RayMask::opaque);
}

std::optional<SurfaceHit> Scene::intersect_through(const Ray& ray, float t_max,
                                                   SurfaceCrossings& crossings) const {
  Crossings found;
  const std::optional<RayHit> hit =
      impl_->intersector.find_through(ray, t_max, RayMask::all, found);
  crossings.clear();
  for (const Crossing& crossing : found) crossings.push_back(impl_->resolve(crossing));
  return hit ? std::optional<SurfaceHit>(impl_->resolve(ray, *hit)) : std::nullopt;
}

std::optional<FoundSurface> Scene::trace(const Ray& ray, float t_max, const Medium*& medium,
                                         MediumSpans& spans) const {
  spans.clear();
  Crossings crossings;
  const std::optional<RayHit> hit =
      impl_->has_boundaries
          ? impl_->intersector.find_through(ray, t_max, RayMask::all, crossings)
          : impl_->intersector.find(ray, t_max, RayMask::all);
  medium = impl_->cut(ray, hit ? hit->t : t_max, medium, crossings, spans);
  if (!hit) return std::nullopt;
  return FoundSurface{*hit, &impl_->surface(hit->group, hit->shape)};
}

const Medium* Scene::media_along(const Ray& ray, float t_max, const Medium* medium,
                                 MediumSpans& spans) const {
  spans.clear();
  Crossings crossings;
  if (impl_->has_boundaries)
    impl_->intersector.find_through(ray, t_max, RayMask::boundary, crossings);
  return impl_->cut(ray, t_max, medium, crossings, spans);
}

bool Scene::is_occluded(const Ray& ray, float t_max) const {
  return impl_->intersector.is_occluded(ray, t_max, RayMask::opaque);
}

const Medium* Scene::medium_across(const SurfaceHit& hit, Vec3 d,
                                   const Medium* current) const {
  const std::optional<BoundaryStep> step = step_across(
      {.t = hit.t, .surface = hit.surface, .goes_out = dot(d, hit.point.ng) > 0});
  if (!step) return current;
  return impl_->sets.cross(current, impl_->medium(step->from), impl_->medium(step->to));
}

std::optional<SelectedLight> Scene::select_light(float u) const {
  if (impl_->lights.empty()) return std::nullopt;
  const DiscreteSample s = impl_->light_power.sample(u);
  if (!(s.probability > 0)) return std::nullopt;
  return SelectedLight{&impl_->lights[s.index], s.index, s.probability};
}

float Scene::light_probability(size_t index) const {
  return impl_->light_power.probability(index);
}

Rgb Scene::environment(Vec3 w) const {
  Rgb sum;
  for (const size_t i : impl_->environments) sum += impl_->lights[i].environment(w);
  return sum;
}

const std::vector<size_t>& Scene::environments() const { return impl_->environments; }

}  // namespace tyndall
