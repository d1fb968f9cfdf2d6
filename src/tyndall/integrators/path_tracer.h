// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tyndall/integrators/integrator.h"
#include "tyndall/integrators/particle_tracer.h"
#include "tyndall/integrators/path.h"

namespace tyndall {

/// Unidirectional volumetric path tracing with next event estimation and, where
/// `connections` asks for them, joint connections through further vertices: the integrators
/// `volpath` (none), `equiangular` (single) and `jis` (single and dual).
class PathTracer : public Integrator {
 public:
  PathTracer(const Scene& scene, const RenderSettings& settings,
             const ConnectionSettings& connections);

  PathSample Li(const Ray& ray, Sampler& sampler) const override;
  uint32_t prepare(uint32_t first, const Deadline& deadline) override;
  ParticleTracer* particles() override { return particles_ ? &*particles_ : nullptr; }
  void report(RenderStatistics& statistics) const override;
  bool learns() const override { return learns_; }
  void dump(GuidingFileWriter& out) const override;

 private:
  struct PilotRays {
    uint32_t first, end;
  };
  template <typename Trace>
  void for_pilot_rays(PilotRays rays, const Trace& trace) const;
  struct Traced {
    PathSample sample;
    int legs;
    float rays;
  };
  Traced trace(const PathRules& rules, const Ray& ray, Sampler& sampler) const;
  float pilot_radiance() const;
  void pretrain(DirectionGuiding& guiding) const;
  void record_plain_paths(const Deadline& deadline) const;
  void add_particles(const RenderSettings& settings);
  void add_connections(const ConnectionSettings& settings);
  void learn_worth();
  void update();
  void give_up_connections();
  void report_connections(RenderStatistics& statistics) const;
  std::string why_no_directions() const;

  const Scene& scene_;
  uint64_t seed_;
  Vec2i resolution_;
  std::optional<ConnectionContext> connections_;
  std::optional<ConnectionBudget> budget_;
  std::optional<WalkWorth> worth_;
  std::optional<ParticleTracer> particles_;
  PathRules rules_, plain_rules_;
  std::vector<std::string> notes_;
  bool learns_;             // if the scene gives reason to
  bool was_tried_ = false;  // whether connections pay
};

}  // namespace tyndall
