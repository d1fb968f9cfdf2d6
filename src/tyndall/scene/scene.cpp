// SPDX-License-Identifier: Apache-2.0
#include "tyndall/scene/scene.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "tyndall/sampling/tabulated.h"
#include "tyndall/scene/camera_medium.h"
#include "tyndall/scene/glow.h"

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
    group.push_back({&surface.shape, is_boundary(surface)});
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

}  // namespace

class Scene::Impl {
 public:
  explicit Impl(SceneDescription d)
      : description(std::move(d)),
        intersector(make_groups(description), make_instances(description)),
        has_boundaries(any_boundary(description)),
        bounds(intersector.bounds()),
        lights(description.lights) {
    bounds.extend(description.camera.position());
    add_area_lights();
    add_volume_light();
    measure_power();
  }

  const Surface& surface(const RayHit& hit) const {
    const std::vector<Surface>& surfaces =
        hit.group == 0 ? description.surfaces : description.objects[hit.group - 1];
    return surfaces[hit.shape];
  }

  SurfaceHit resolve(const Ray& ray, const RayHit& hit) const {
    const size_t light = hit.group == 0 ? light_of_surface[hit.shape] : no_light;
    return {.t = hit.t,
            .point = intersector.resolve(ray, hit).point,
            .surface = &surface(hit),
            .light = light == no_light ? nullptr : &lights[light],
            .light_index = light};
  }

  std::optional<SurfaceHit> intersect(const Ray& ray, float t_max, RayMask mask) const {
    const std::optional<RayHit> hit = intersector.find(ray, t_max, mask);
    return hit ? std::optional<SurfaceHit>(resolve(ray, *hit)) : std::nullopt;
  }

  const Medium* medium(int index) const {
    return index == no_medium ? nullptr : &description.media[static_cast<size_t>(index)];
  }

  SceneDescription description;
  Intersector intersector;
  bool has_boundaries;
  Bounds3 bounds;
  std::vector<Light> lights;
  std::vector<size_t> environments;      // indices of lights that rays can escape to
  std::vector<size_t> light_of_surface;  // or no_light
  std::optional<size_t> volume_light;    // index
  bool has_glow = false;
  DiscreteDistribution light_power;
  const Medium* camera_medium = nullptr;
  std::vector<std::string> remarks;

 private:
  void add_area_lights() {
    light_of_surface.assign(description.surfaces.size(), no_light);
    for (size_t i = 0; i < description.surfaces.size(); ++i) {
      const Surface& surface = description.surfaces[i];
      if (!surface.emission || is_black(surface.emission->L)) continue;
      light_of_surface[i] = lights.size();
      lights.emplace_back(AreaLight{.shape = &surface.shape,
                                    .L = surface.emission->L,
                                    .two_sided = surface.emission->two_sided});
    }
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
  impl_->camera_medium = impl_->medium(finding.medium);
  if (!finding.remark.empty()) impl_->remarks.push_back(finding.remark);
}

Scene::~Scene() = default;

const PerspectiveCamera& Scene::camera() const { return impl_->description.camera; }
const Medium* Scene::camera_medium() const { return impl_->camera_medium; }
const std::vector<Light>& Scene::lights() const { return impl_->lights; }
Bounds3 Scene::bounds() const { return impl_->bounds; }
std::optional<size_t> Scene::volume_light() const { return impl_->volume_light; }
bool Scene::has_glow() const { return impl_->has_glow; }
bool Scene::has_boundaries() const { return impl_->has_boundaries; }
const std::vector<std::string>& Scene::remarks() const { return impl_->remarks; }
const SceneDescription& Scene::description() const { return impl_->description; }

std::optional<SurfaceHit> Scene::intersect(const Ray& ray, float t_max) const {
  return impl_->intersect(ray, t_max, RayMask::all);
}

std::optional<FoundSurface> Scene::find(const Ray& ray, float t_max) const {
  const std::optional<RayHit> hit = impl_->intersector.find(ray, t_max, RayMask::all);
  if (!hit) return std::nullopt;
  return FoundSurface{*hit, &impl_->surface(*hit)};
}

SurfaceHit Scene::resolve(const Ray& ray, const FoundSurface& found) const {
  return impl_->resolve(ray, found.hit);
}

std::optional<SurfaceHit> Scene::intersect_opaque(const Ray& ray, float t_max) const {
  return impl_->intersect(ray, t_max, RayMask::opaque);
}

std::optional<SurfaceHit> Scene::intersect_boundary(const Ray& ray, float t_max) const {
  if (!impl_->has_boundaries) return std::nullopt;
  return impl_->intersect(ray, t_max, RayMask::boundary);
}

bool Scene::is_occluded(const Ray& ray, float t_max) const {
  return impl_->intersector.is_occluded(ray, t_max, RayMask::opaque);
}

const Medium* Scene::medium_across(const SurfaceHit& hit, Vec3 d,
                                   const Medium* current) const {
  const MediumInterface& media = hit.surface->media;
  if (!media.is_stated || !media.is_transition()) return current;
  return impl_->medium(dot(d, hit.point.ng) > 0 ? media.outside : media.inside);
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
