// All ways of connecting a light and a camera subpath into a path (Veach & Guibas 1994; Lafortune &
// Willems 1993), each with its multiple importance sampling weight. This is the text to read and to
// change first; `bdpt` renders by wave/bidirectional_wave.h where it can, which is tested
// against it (docs/waves.md).
#pragma once

#include "path/background_positions.h"
#include "path/connection.h"
#include "path/manifold_sampler.h"
#include "path/mis.h"
#include "path/path_terms.h"
#include "path/refracted_light.h"
#include "path/subpath.h"

#include <vector>

namespace mlt {

struct BidirectionalSettings {
  PathRules rules;
  bool light_image = true;    ///< Techniques t <= 1, which splat anywhere on the image.
  bool sample_direct = true;  ///< s = 1 samples x_0 for x_1.
  Heuristic heuristic = Heuristic::power;
  /// Set to join lights to smooth vertices and to the lens across chains, by ManifoldSampler.
  std::shared_ptr<const ManifoldGuide> manifolds = nullptr;
};

/// A light and a camera subpath, and the connections between them. Reuses its buffers from sample
/// to sample.
class BidirectionalSampler {
 public:
  BidirectionalSampler(const Scene& scene, const BidirectionalSettings& settings)
      : scene_(&scene), settings_(settings), lens_can_be_hit_(scene.camera().can_be_hit()) {
    if (settings.manifolds) manifold_.emplace(scene, settings.manifolds);
    refracts_ = settings.rules.through_boundaries && settings.sample_direct &&
                RefractedLight::serves(scene);
  }

  /// Draws both subpaths for a raster position.
  template <class Sampler>
  void sample(const Vec2& raster, Sampler& sampler, RayCounts& rays) {
    const int edges = settings_.rules.most_edges();
    sampler.begin(Stream::camera);
    walk_from_camera(raster, {edges + 1, false}, sampler, rays);
    walk_from_light(walker(rays), settings_.rules, longest_light_walk(), sampler, light_);
    draw_direct(sampler);
    if (manifold_ || refracts_) extra_seed_ = static_cast<uint64_t>(0x1p53 * sampler.next());
    sum_techniques(rays);
  }

  /// Draws a raster position, and the parts of both subpaths that the technique needs; then calls
  /// found(connection), at most once. Of several lights at infinity, technique s = 0 chooses one.
  template <class Sampler, class Found>
  void sample_technique(const Technique& technique, Sampler& sampler, RayCounts& rays,
                        Found&& found) {
    const auto [s, t] = technique;
    sampler.begin(Stream::camera);
    walk_from_camera(scene_->camera().raster().sample(sampler.next2()), {t, false}, sampler, rays);
    if (static_cast<int>(camera_.size()) < t) return;
    light_.clear();
    const WalkLength most = t == 0 ? WalkLength{s - 1, true} : WalkLength{s, false};
    const bool direct = t > 0 && is_direct(s);
    if (s > 0 && !direct) walk_from_light(walker(rays), settings_.rules, most, sampler, light_);
    if (!direct && static_cast<int>(light_.size()) < most.vertices) return;
    sampler.begin(Stream::direct);
    sum_techniques(rays);
    if (s == 0)
      hit_one_light(t, sampler, rays, found);
    else if (t == 0)
      hit_lens(s, rays, found);
    else
      connect_one(s, t, direct, sampler, rays, found);
  }

  /// Draws a light subpath and a point on the lens alone.
  template <class Sampler>
  void sample_light(Sampler& sampler, RayCounts& rays) {
    sampler.begin(Stream::camera);
    const PositionSample lens = start_from_lens(sampler);
    camera_.start(camera_vertex(lens.at), lens.pdf);
    walk_from_light(walker(rays), settings_.rules, longest_light_walk(), sampler, light_);
    draw_direct(sampler);
    sum_techniques(rays);
  }

  /// Calls found(connection) for each path with a positive contribution.
  template <class Found>
  void connect_all(RayCounts& rays, Found&& found) {
    connect_walks(rays, found);
    if (manifold_) connect_by_manifolds(rays, found);
    if (refracts_) connect_through_boundaries(rays, found);
  }
  /// As above, for the techniques that join two walks by an edge.
  template <class Found>
  void connect_walks(RayCounts& rays, Found&& found) {
    if (settings_.light_image) connect_to_lens(rays, found);
    for (int t = 2; t <= static_cast<int>(camera_.size()); ++t) {
      check_abandoned();  // most pairs of vertices may need no ray, which would be counted
      hit_light(t, rays, found);
      for (int s = 1; s <= std::max(1, static_cast<int>(light_.size())); ++s)
        connect(s, t, rays, found);
    }
    if (settings_.light_image && lens_can_be_hit_)
      for (int s = 2; s <= static_cast<int>(light_.size()) + 1; ++s) hit_lens(s, rays, found);
  }

  /// Calls found(connection) for each connection with t = 1.
  template <class Found>
  void connect_to_lens(RayCounts& rays, Found&& found) {
    for (int s = 1; s <= std::max(1, static_cast<int>(light_.size())); ++s)
      connect(s, 1, rays, found);
  }

  /// Calls found(connection) for paths in which a chain joins the light to the camera subpath.
  template <class Found>
  void connect_by_manifolds(RayCounts& rays, Found&& found) {
    Rng rng(extra_seed_, Purpose::manifold, 0);
    for (int t = 1; t <= static_cast<int>(camera_.size()) && light_.size() > 0; ++t) {
      Connection connection{0, t, raster_, Color(0), 0};
      if (evaluate_manifold(connection, rng, rays)) found(connection);
    }
  }

  /// Calls found(connection) for paths in which light enters a medium through a rough boundary.
  template <class Found>
  void connect_through_boundaries(RayCounts& rays, Found&& found) {
    Rng rng(extra_seed_, Purpose::boundary, 0);
    for (int t = 2; t <= static_cast<int>(camera_.size()); ++t) {
      Connection connection{2, t, raster_, Color(0), 0};
      if (wanted(2, t) && evaluate_refracted(connection, rng, rays)) found(connection);
    }
  }

  /// Assembles the path of a connection that was just found.
  void assemble(const Connection& connection, Path& path) const;

  const BidirectionalSettings& settings() const { return settings_; }
  const Subpath& light() const { return light_; }
  const Subpath& camera() const { return camera_; }
  double time() const { return time_; }

 private:
  bool wanted(int s, int t) const { return settings_.rules.wants(s + t - 1); }
  /// Whether x_0 is sampled for x_1 (next-event estimation).
  bool is_direct(int s) const { return s == 1 && settings_.sample_direct; }
  Walker walker(RayCounts& rays) const { return {*scene_, time_, rays, wavelength_}; }
  /// A light walk may still hit the lens from its last vertex.
  WalkLength longest_light_walk() const { return {settings_.rules.most_edges(), true}; }

  /// Draws a point on the lens, and with it the time and the wavelength.
  template <class Sampler>
  PositionSample start_from_lens(Sampler& sampler) {
    const PositionSample lens = sample_lens(scene_->camera(), sampler);
    time_ = lens.at.time;
    wavelength_ = lens.at.wavelength;
    return lens;
  }
  template <class Sampler>
  void walk_from_camera(const Vec2& raster, const WalkLength& most, Sampler& sampler,
                        RayCounts& rays) {
    raster_ = raster;
    const PositionSample lens = start_from_lens(sampler);
    const Ray ray = camera_ray(scene_->camera(), lens.at, raster);
    camera_.start(camera_vertex(lens.at), lens.pdf);
    const double pdf = scene_->camera().pdf_direction(lens.at, ray.d);
    if (pdf > 0) camera_.walk(walker(rays), settings_.rules, {ray, pdf}, most, sampler);
  }

  template <class Sampler>
  void draw_direct(Sampler& sampler) {
    sampler.begin(Stream::direct);
    direct_u_.clear();
    for (size_t i = 0; i < camera_.size(); ++i)
      direct_u_.push_back(DirectNumbers::draw(sampler).for_light());
    if (!scene_->infinite_emitters().empty()) sample_backgrounds();
  }

  template <class Sampler, class Found>
  void connect_one(int s, int t, bool direct, Sampler& sampler, RayCounts& rays, Found& found) {
    if (direct) {
      direct_u_.resize(t);
      direct_u_.back() = DirectNumbers::draw(sampler).for_light();
      direct_backgrounds_.clear();
    }
    connect(s, t, rays, found);
  }

  template <class Sampler, class Found>
  void hit_one_light(int t, Sampler& sampler, RayCounts& rays, Found& found) {
    const std::vector<uint32_t>& infinite = scene_->infinite_emitters();
    const double u =
        sampler.next();  // for all paths, so that all of a technique draw as many numbers
    if (!camera_[t - 1].vertex.at.infinite() || infinite.size() == 1)
      return hit_light(t, rays, found);
    const double count = static_cast<double>(infinite.size());
    const auto chosen = static_cast<size_t>(u * count);
    emit(*scene_->emitters()[infinite[chosen]], t, rays, [&](Connection& connection) {
      connection.contribution *= count;
      connection.own_share /= count;
      found(connection);
    });
  }

  template <class Found>
  void hit_light(int t, RayCounts& rays, Found& found) {
    if (!wanted(0, t)) return;
    const SurfacePoint& end = camera_[t - 1].vertex.at;
    if (end.infinite()) {
      for (const uint32_t index : scene_->infinite_emitters())
        emit(*scene_->emitters()[index], t, rays, found);
    } else if (const Emitter* emitter = scene_->emitter(end)) {
      emit(*emitter, t, rays, found);
    }
  }

  template <class Found>
  void emit(const Emitter& emitter, int t, RayCounts& rays, Found&& found) {
    Connection connection{0, t, raster_, Color(0), 0, &emitter};
    if (evaluate_hit_light(connection, rays)) found(connection);
  }

  template <class Found>
  void connect(int s, int t, RayCounts& rays, Found& found) {
    Connection connection{s, t, raster_, Color(0), 0};
    if (wanted(s, t) && evaluate_connection(connection, rays)) found(connection);
  }

  template <class Found>
  void hit_lens(int s, RayCounts& rays, Found& found) {
    Connection connection{s, 0, raster_, Color(0), 0};
    if (wanted(s, 0) && evaluate_hit_lens(connection, rays)) found(connection);
  }

  // certainty() of a path that one walk alone has made.
  double certainty_of_hit_light(int t) const;
  double certainty_of_hit_lens(int s, const Arrival& from_lens) const;
  /// The sums over the techniques whose joint lies beyond vertex i of a subpath, for a path joined
  /// at x, which is that vertex or one sampled in its place; `back` is the density of the
  /// direction to the previous vertex, in projected solid angle, and the likelihood is that of the
  /// other walk, which has come to x.
  TechniqueSums below_joint(int i, const WalkVertex& x, double back, Spectrum likelihood) const;
  TechniqueSums above_joint(int i, const WalkVertex& x, double back, Spectrum likelihood) const;

  bool evaluate_hit_light(Connection& connection, RayCounts& rays);
  bool evaluate_connection(Connection& connection, RayCounts& rays);
  bool evaluate_hit_lens(Connection& connection, RayCounts& rays);
  bool evaluate_manifold(Connection& connection, Rng& rng, RayCounts& rays);
  bool evaluate_refracted(Connection& connection, Rng& rng, RayCounts& rays);
  void complete_assembled(const Connection& connection);
  bool evaluate_assembled(const ExtraTechnique& technique, Connection& connection);
  double manifold_count(int m, const Vertex& end) const;
  double manifold_over_hit_light(const Vertex& x0, double from_light, int t) const;
  double refracted_over(double density, const Vertex& x0, const Vertex& x1, const Vertex& x2,
                        RayCounts& rays) const;
  double refracted_over_hit_light(const Vertex& x0, int t, RayCounts& rays) const;
  void sample_backgrounds();
  bool choose_direct(int t);

  // The techniques that can make a path of these subpaths, indexed by the vertex of a subpath (its
  // end is number 0) that the joint has moved over.
  void sum_techniques(RayCounts& rays);
  TechniqueSums light_techniques(int i, bool joined = false) const;
  double camera_technique(int i, bool joined = false) const;
  /// The sums over techniques with a joint before or at vertex i of a subpath, whose density by a
  /// walk from the other end is `reverse`, and at which its likelihood is given.
  TechniqueSums below_light(int i, double reverse, const Spectrum& likelihood) const;
  TechniqueSums above_camera(int i, double reverse, const Spectrum& likelihood) const;
  double direct_over_walk(const Vertex& x0, double from_light, const SurfacePoint& x1) const;

  /// Computes the weights; false if that of this technique is 0.
  bool weigh(Connection& connection, double own, const TechniqueSums& below,
             const TechniqueSums& above, double survival) const;

  const Scene* scene_;
  BidirectionalSettings settings_;
  bool lens_can_be_hit_;
  Subpath light_{Subpath::From::light}, camera_{Subpath::From::camera};
  Vec2 raster_{0};
  double time_ = 0, wavelength_ = rgb_lanes;
  std::vector<Vec3> direct_u_;  ///< Numbers for s = 1, one triple for each camera vertex.
  BackgroundPositions backgrounds_;
  /// Lights at infinity sampled by direct_u_; without an emitter where another is chosen. Or empty.
  std::vector<LightSample> direct_backgrounds_;
  WalkVertex direct_;      ///< x_0 of technique s = 1, sampled for x_1.
  double direct_pdf_ = 0;  ///< Density of sampling direct_ for x_1.
  Vertex lens_;            ///< The end that was hit for t = 0.
  /// Sums over the techniques whose joint is in one of the subpaths, up to vertex i: of their
  /// densities over that of the technique which joins before vertex i.
  std::vector<TechniqueSums> light_sums_, camera_sums_;
  std::optional<ManifoldSampler> manifold_;
  bool refracts_ = false;  ///< Whether there is the technique of refracted_light.h.
  uint64_t extra_seed_ = 0;
  Path assembled_;  ///< The path of the last connection that was assembled.
  PathTerms assembled_terms_;
  mutable std::vector<Vertex> chain_;  ///< Scratch: a chain and its ends.
  double light_direct_over_walk_ = 1;  ///< direct_over_walk() of the first two vertices of light_.
  double light_refracted_ = 0;  ///< refracted_over() of its first three, over technique s = 2.
};

}  // namespace mlt
