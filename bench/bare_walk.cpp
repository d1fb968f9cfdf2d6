// SPDX-License-Identifier: Apache-2.0
#include "bare_walk.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>

#include "tyndall/math/frame.h"
#include "tyndall/media/tracking.h"
#include "tyndall/media/transmittance.h"
#include "tyndall/sampling/warps.h"

namespace tyndall {
namespace {

RTCRay to_embree(const Ray& ray, float t_max) {
  return {.org_x = ray.o.x,
          .org_y = ray.o.y,
          .org_z = ray.o.z,
          .tnear = 1e-4f,
          .dir_x = ray.d.x,
          .dir_y = ray.d.y,
          .dir_z = ray.d.z,
          .time = 0,
          .tfar = t_max,
          .mask = ~0u,
          .id = 0,
          .flags = 0};
}

}  // namespace

class BareWalk::Impl {
 public:
  Impl(const TriangleMesh& mesh, const Medium& medium, Vec3 light)
      : medium_(medium),
        light_(light),
        device_(rtcNewDevice(nullptr)),
        scene_(rtcNewScene(device_)) {
    const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    std::copy(mesh.positions().begin(), mesh.positions().end(),
              static_cast<Vec3*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX,
                                                         0, RTC_FORMAT_FLOAT3, sizeof(Vec3),
                                                         mesh.positions().size())));
    std::copy(mesh.triangles().begin(), mesh.triangles().end(),
              static_cast<Vec3i*>(rtcSetNewGeometryBuffer(
                  geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(Vec3i),
                  mesh.triangles().size())));
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
  }
  ~Impl() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  float walk(Ray ray, int max_depth, float albedo, float reflectance,
             RandomStream& rng) const {
    float sum = 0;
    for (int depth = 1;; ++depth) {
      RTCRayHit query{.ray = to_embree(ray, infinity), .hit = {}};
      query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
      RTCIntersectContext context;
      rtcInitIntersectContext(&context);
      rtcIntersect1(scene_, &context, &query);
      if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return sum;
      const float t = free_flight(ray, query.ray.tfar, rng);
      const bool is_in_medium = t < query.ray.tfar;
      ray.o = ray.at(t);
      sum += light_at(ray.o, rng);
      const float survival = is_in_medium ? albedo : reflectance;
      if (depth == max_depth || (depth > 1 && rng.next_1d() >= survival)) return sum;
      const Vec3 ng{query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z};
      const Vec3 n = dot(ng, ray.d) > 0 ? -ng : ng;
      ray.d = is_in_medium ? sample_uniform_sphere(rng.next_2d())
                           : Frame::from_z(normalize(n))
                                 .to_world(sample_cosine_hemisphere(rng.next_2d()));
    }
  }

 private:
  float free_flight(const Ray& ray, float t_max, RandomStream& rng) const {
    float found = t_max;
    medium_.visit([&](const auto& medium) {
      sample_collisions(medium, ray, t_max, 0, rng,
                        [&](float t, const MediumProperties& p, Rgb majorant, Rgb) {
                          if (rng.next_1d() * majorant.r >= p.sigma_t().r) return true;
                          found = t;
                          return false;
                        });
    });
    return found;
  }

  float light_at(Vec3 p, RandomStream& rng) const {
    const Vec3 to_light = light_ - p;
    const float distance = length(to_light);
    const Ray shadow{p, to_light / distance};
    RTCRay query = to_embree(shadow, distance);
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(scene_, &context, &query);
    if (query.tfar < 0) return 0;
    return estimate_transmittance(medium_, shadow, distance, rng,
                                  TransmittanceMethod::ratio_tracking)
               .r /
           sqr(distance);
  }

  const Medium& medium_;
  Vec3 light_;
  RTCDevice device_;
  RTCScene scene_;
};

BareWalk::BareWalk(const TriangleMesh& mesh, const Medium& medium, Vec3 light)
    : impl_(std::make_unique<Impl>(mesh, medium, light)) {}
BareWalk::~BareWalk() = default;

float BareWalk::walk(const Ray& ray, int max_depth, float albedo, float reflectance,
                     RandomStream& rng) const {
  return impl_->walk(ray, max_depth, albedo, reflectance, rng);
}

}  // namespace tyndall
