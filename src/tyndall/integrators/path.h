// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>

#include "tyndall/guiding/walk_worth.h"
#include "tyndall/image/film.h"
#include "tyndall/integrators/connection_budget.h"
#include "tyndall/integrators/leg.h"
#include "tyndall/integrators/render_settings.h"
#include "tyndall/integrators/tail.h"
#include "tyndall/integrators/vertex.h"
#include "tyndall/sampling/sampler.h"

namespace tyndall {

class DualDirection;
class ParticleTracer;

/// What every path of a render shares.
struct PathRules {
  int max_depth;
  ScatteringOrders orders;
  bool is_chromatic;      ///< some medium differs between the colour channels
  bool walks_find_light;  ///< something that glows is not a Dirac delta
  /// A grey homogeneous medium that fills the scene, where walks need to know no more of
  /// their legs than what they collide with; null otherwise.
  const Medium* filling = nullptr;
  const ConnectionContext* connections;  ///< null: next event estimation only
  const ConnectionBudget* budget;        ///< null: each connection once
  /// Null: walks survive by what they carry, not by what they are worth. Needs the budget.
  const WalkWorth* worth = nullptr;
  /// Predicts where skies are seen; null: they are sampled as if nothing hid them.
  const LightVisibility* visibility = nullptr;
  /// Nothing hides a light from a connection: for training only.
  bool sees_through = false;
  /// Null: walks alone find light that lamps send over specular surfaces.
  const ParticleTracer* particles = nullptr;
};

/// One camera path in the making: a random walk whose steps are its member functions.
///
/// Colour: distances are drawn for one channel, the hero. `spectral_` holds the density
/// with which each channel would have drawn the same walk, relative to the hero's; dividing
/// by the mean over channels is single-sample spectral MIS [Wilkie14] over the choice of
/// the hero.
class Path {
 public:
  Path(const Scene& scene, const PathRules& rules, const Ray& ray, Sampler& sampler);

  const Ray& ray() const { return ray_; }
  const Medium* medium() const { return medium_; }

  /// Connects vertices on the leg, beyond what the walk will choose, to lights: adds the
  /// light of paths with one and with two more scattering vertices in media.
  void connect(Leg& leg);
  /// Makes a dual connection on the leg to teach the guiding; adds nothing.
  void rehearse(Leg& leg);
  /// Adds the light of what the first leg ends at, as far as it is seen through media: the
  /// walk gets there by chance only.
  void look_at_end(Leg& leg);
  /// Goes along the leg to the next scattering vertex; adds what glows on the way. False if
  /// the path ends.
  bool advance(Leg& leg);
  /// Next event estimation: connects the vertex to a light.
  void estimate_direct();
  /// Draws the direction of the next leg and plays Russian roulette. False if the path
  /// ends.
  bool scatter();

  /// Tells the budget what the path found. To be called once, at the end.
  void finish() const;
  const PathSample& result() const { return result_; }
  int legs() const { return depth_ + 1; }
  /// Two for each leg, one along it and one to a light, and those of connections.
  float rays() const { return 2 * static_cast<float>(legs()) + spent_; }

 private:
  bool meet_medium(float t, const Medium* medium);
  std::optional<float> fly_freely(Leg& leg);
  std::optional<float> sample_collision(const Ray& ray, const Leg::Span& span);
  void add_glow(Leg& leg);
  void add_surface_emission(const SurfaceHit& hit);
  void add_environment();
  bool arrive(float t);
  bool survives_roulette();
  float survival(float carried) const;
  // What draws numbers of its own at each depth: the same ones in all samples of a pixel,
  // however often the others were made.
  enum class Step : uint32_t { direct, direction, connections };
  void start_block(Step step, uint32_t i = 0) {
    constexpr uint32_t steps = 2 + effort_count * most_of_a_kind;
    sampler_.start_block(1 + static_cast<uint32_t>(depth_) * steps +
                         static_cast<uint32_t>(step) + i);
  }
  void depart(float carried);
  void tell_worth() const;
  void add(Rgb contribution) { result_.L += contribution / average(spectral_); }

  // Light that arrives at a vertex from a light, and the densities of the sample.
  struct Connection {
    Rgb light;  // f * T * L, or black
    LightEnd end;
  };
  Connection connect_to(const Vertex& vertex, const SelectedLight& selected);
  const SkyGuide* sky_guide(size_t light) const;
  void connect_vertex();
  Rgb arriving(const SelectedLight& selected, const LightSample& sample, const Ray& shadow,
               const Medium* medium);
  std::optional<SelectedLight> select_light(float u);  // from the vertex
  const LightProbabilities& lights_at_vertex();
  float number_for_light();
  Vec2 numbers_on(const Light& light);
  float light_probability(Vec3 p, size_t light) const;
  bool is_left_to_connections(size_t light);
  TailCounts tail_counts(int vertices) const {
    return {&counts_, vertices, probability_of_first_};
  }
  float direct_weight(const LightEnd& end);
  float hit_weight(size_t light, float light_pdf, float distance);
  float particle_ratio(const DirectionSample& s) const;
  float weight_beside_particles(const SurfaceHit& hit) const;
  bool counts(int in_media, int on_surfaces = 0) const;
  // What one connection finds, before spectral MIS.
  Rgb connect_single(Leg& leg);
  Rgb connect_at(Leg& leg, const DistanceSample& s, const Medium& medium,
                 const SelectedLight& selected, float TailDensities::*technique);
  void enter(Leg& leg);
  Rgb connect_dual(Leg& leg);
  Rgb connect_forced(Leg& leg);
  Rgb connect_glow();  // from the vertex
  float glow_around_lights();
  struct DualStart;
  struct ScatteredOnce;
  ScatteredOnce connect_beyond(const DualStart& start, float u,
                               float TailDensities::*technique);
  float weight_beyond(const DualStart& start, ConnectionLeg& next, float t,
                      const LightEnd& end, float TailDensities::*technique);
  void teach(const DualStart& start, const DualDirection& technique,
             const ScatteredOnce& found);
  template <typename Connect>
  void spend(Effort effort, float predicted, const Connect& connect);
  float carried() const { return luminance(beta_) / average(spectral_); }

  // A lit point as seen from a vertex x before it.
  struct LitView {
    Vec3 w;  // towards it, unit
    float distance;
    Rgb light;  // that arrives at x from it, over the density of the lit point
  };
  std::optional<LitPoint> sample_lit_point(size_t place);
  Rgb record(size_t place, const LitPoint& lit, Rgb value) const;
  Rgb transmittance_to_light(const LitPoint& lit, const Medium* medium);
  LightEnd light_end(const LitPoint& lit) const;
  std::optional<LitView> look_at(const LitPoint& lit, const Vertex& x);
  float lit_weight(const LitPoint& lit, int vertices, float edge, const LitChain& beyond);
  Rgb connect_lit(Leg& leg);  // from the leg
  Rgb connect_lit();          // from the vertex
  float edge_density(const LegStart& x, const ConnectionLeg& before, const SurfacePoint& y,
                     Vec3 w, float distance) const;
  LitChain chain_to(const Vertex& y, float distance) const;

  const Scene& scene_;
  const PathRules& rules_;
  Sampler& sampler_;
  RandomStream tracking_;
  uint64_t key_;          // of the path
  uint64_t lessons_ = 0;  // training samples so far

  Ray ray_;
  const Medium* medium_;
  Rgb beta_{1};
  Rgb spectral_{1};
  int hero_ = 0;
  int depth_ = 0;                   // scattering vertices so far
  int order_ = 0;                   // of them, in media
  bool saw_end_ = false;            // of this leg
  float probability_of_first_ = 1;  // see TailCounts
  float eta_scale_ = 1;
  std::optional<Vertex> vertex_;
  std::optional<LightProbabilities> lights_at_vertex_;  // once somebody asks
  float t_vertex_ = 0;                                  // along the leg to it

  // The last legs, for the densities of techniques that the walk did not use.
  Pivots pivots_;
  LitChain chain_;  // to vertex_; while the walk is on a leg, to where that starts
  ConnectionLeg no_leg_;
  ConnectionLeg *leg_ = &no_leg_, *leg_before_ = &no_leg_, *leg_two_before_ = &no_leg_;
  std::array<std::optional<ConnectionLeg>, 3> legs_;  // the same, in turn
  LegStart start_;                                    // of leg_
  LegStart start_before_;                             // of leg_before_
  PathSample result_;
  float particle_ratio_ = 0;  // ParticleRatio of the vertices so far
  ConnectionCounts counts_;
  float spent_ = 0;      // on connections
  float lit_share_ = 0;  // weight of the last connection to a lit surface
  float lit_gain_ = 0, lit_spent_ = 0;

  // Where the walk left its first vertices, and what the path was worth until then.
  struct Departure {
    size_t place;  // see WalkWorth
    float carried, found, cost;
  };
  std::array<Departure, 8> departures_;
  size_t departed_ = 0;
};

// Makes the connection as often as the budget says, on average. What it is predicted to
// find is relative to what the walk carries.
template <typename Connect>
void Path::spend(Effort effort, float predicted, const Connect& connect) {
  const ConnectionBudget* budget = rules_.budget;
  const ConnectionPlace place{.region = counts_.region(),
                              .effort = effort,
                              .depth = depth_,
                              .predicted = predicted * carried()};
  const float wanted = counts_(place);
  if (budget && budget->is_recording()) budget->record_place(place);
  const auto whole = static_cast<int>(wanted);
  const float rest = wanted - static_cast<float>(whole);
  const int count = whole + (rest > 0 && tracking_.next_1d() < rest ? 1 : 0);
  if (count == 0) return;
  Rgb sum;
  float found[2] = {0, 0}, share = 0;
  for (int i = 0; i < count; ++i) {
    start_block(Step::connections,
                static_cast<uint32_t>(effort) * most_of_a_kind + static_cast<uint32_t>(i));
    const Rgb value = connect();
    sum += value;
    if (i == 0) share = lit_share_;
    if (i < 2) found[i] = luminance(value) / average(spectral_);
  }
  add(sum / wanted);
  if (!budget || !budget->is_recording()) return;
  budget->record(place, found[0]);
  spent_ += ConnectionBudget::cost(effort, count);
  if (effort == Effort::lit_from_leg || effort == Effort::lit_from_vertex) {
    lit_spent_ += ConnectionBudget::cost(effort, count);
    lit_gain_ +=
        ConnectionBudget::lit_gain(found[0], share, wanted) / std::min(wanted, 1.0f);
  }
  if (count < 2) return;
  budget->record_pair(place, 0.5f * sqr(found[0] - found[1]));
}

}  // namespace tyndall
