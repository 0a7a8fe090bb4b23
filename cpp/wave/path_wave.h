// Paths from the camera that are traced side by side: all take their first step, then all take the
// second one. The accelerator gets their rays in packets, and Lambertian vertices are computed
// together. Every path is that of trace_path, up to rounding. S. Laine, T. Karras, T. Aila,
// "Megakernels considered harmful: wavefront path tracing on GPUs", High-Performance Graphics 2013.
#pragma once

#include "markov/clamping_weights.h"
#include "path/background_positions.h"
#include "path/path_tracer.h"
#include "wave/drawn_numbers.h"
#include "wave/glossy_vertices.h"
#include "wave/single_vertices.h"
#include "wave/wave_hits.h"
#include "wave/wave_legs.h"
#include "wave/wave_numbers.h"
#include "wave/wave_shadows.h"

namespace mlt {

/// The weights w1 (ClampingWeights) of paths at one raster position.
struct PathWeights {
  /// T / (P c) of a path whose f / P has L* = 1; 0: all weights are 1.
  double factor = 0;
  double certain_factor = 0;  ///< `factor` of a path whose certainty is above 0.
  /// Chains do not find paths with a greater `certainty`.
  double most_certain = std::numeric_limits<double>::infinity();

  /// The weight of a path; with the balance heuristic f / P is its radiance, without roulette.
  double of(const Color& radiance, double survival, double certainty) const {
    if (!(factor > 0 && certainty <= most_certain)) return 1;
    const double tau = (certainty > 0 ? certain_factor : factor) * survival;
    return ClampingWeights::of_sample(tau * target_luminance(radiance), 1);
  }
};

/// A walk in a wave, which watches itself.
struct WaveWalk : CameraWalk, IgnorePaths {
  using CameraWalk::CameraWalk;
  double find(const CameraWalk&, const Color& found, double its_certainty) const {
    return weights.of(found, survival, its_certainty);
  }

  RayCounts rays;
  PathWeights weights;
};

/// `Numbers` is the source of the random numbers of the paths: WaveNumbers or DrawnNumbers.
template <class Numbers>
class BasicPathWave {
 public:
  static constexpr size_t capacity = wave_size;

  BasicPathWave(const Scene& scene, const PathRules& rules, Heuristic heuristic = Heuristic::power)
      : scene_(&scene), rules_(rules), mis_(heuristic) {
    walks_.reserve(capacity);
  }

  /// The random numbers of the paths that are added.
  Numbers& numbers() { return numbers_; }
  /// Adds a path that begins with `ray`, and takes the numbers of the sample that was added last.
  void add(const Ray& ray, const PathWeights& weights = {}) {
    path_[live_] = live_;
    exact_[live_] = true;
    o_.set(live_, Vec3f(ray.o));
    d_.set(live_++, Vec3f(ray.d));
    last_part_[walks_.size()] = -1;
    WaveWalk& walk = walks_.emplace_back(ray);
    walk.mis = mis_;
    walk.weights = weights;
    walk.certainty = weights.factor > 0;
    walk.rays.intersect = 1;
  }
  /// Adds a path that begins with `ray` and takes the next numbers of `sampler`, a PixelSampler.
  template <class Sampler>
  void add(const Ray& ray, const Sampler& sampler) {
    numbers_.add(sampler.stream(), sampler.index());
    numbers_.places() = sampler.position();
    add(ray);
  }
  size_t size() const { return walks_.size(); }
  bool full() const { return size() == capacity; }
  /// Traces all paths to their ends. `coherent`: the first rays of adjacent paths are similar.
  void trace(RayCounts& rays, bool coherent = true);
  /// Whether the radiance of each emitter is kept apart, too.
  void keep_emitters(bool keep) { keeps_emitters_ = keep; }
  bool keeps_emitters() const { return keeps_emitters_; }
  /// Calls show(emitter, radiance) for all parts of the radiance of the i-th path.
  template <class Show>
  void show_emitters(size_t i, Show&& show) const {
    for (int k = last_part_[i]; k >= 0; k = parts_[k].before)
      show(parts_[k].emitter, parts_[k].rgb);
  }
  /// The radiance that the i-th path has found.
  const Color& radiance(size_t i) const { return walks_[i].radiance; }
  /// The number of rays of the i-th path.
  const RayCounts& rays(size_t i) const { return walks_[i].rays; }
  void clear() {
    walks_.clear();
    parts_.clear();
    numbers_.clear();
    live_ = 0;
  }

 private:
  /// A vertex on a mesh that samples a light at infinity.
  struct SkyVertex {
    int path;
    EmitterChoice choice;
    Vec2 u;
    LightSample light;
  };

  /// Light behind media, and surfaces that it may have to pass, as if there were none.
  struct LightToPass {
    Spectrum light;
    bool disperses;
    double mis, survival;
    Spectrum likelihood;  ///< That with which its path would go on.
    Spectrum stops;       ///< See `light_stops_`.
    MediumIndex medium;   ///< In which the shadow ray begins.
  };

  /// A part of the radiance of a path; `before` is its path's last one, or -1.
  struct Part {
    int before;
    uint32_t emitter;
    Color rgb;
  };
  void receive(int path, uint32_t emitter, const Color& rgb) {
    walks_[path].radiance += rgb;
    if (keeps_emitters_) keep(path, emitter, rgb);
  }
  void keep(int path, uint32_t emitter, const Color& rgb) {
    parts_.push_back({last_part_[path], emitter, rgb});
    last_part_[path] = static_cast<int>(parts_.size()) - 1;
  }
  /// Finds the light at the end of the ray of the path at this place.
  void find_light_at_end(int place, WaveWalk& walk, const SurfacePoint* at);

  void find_hits(bool coherent, RayCounts& rays);
  void begin_vertices(bool last);
  void follow_legs(RayCounts& rays);
  void arrive(int place, WaveWalk& walk, const SurfacePoint* at);
  void find_shadows(RayCounts& rays);
  void receive_through(int shadow, bool passes_surfaces);

  // Functions of the `count_` paths from the begin_-th one on:
  void shade_block(int depth, RayCounts& rays);
  void read_numbers(int depth);
  Vec3 numbers_for_light(int i) const;
  void find_vertex(int i, int depth);
  void leave_scene(int place, int depth);
  void find_single(int i, const Hit& hit, int depth, bool in_lanes);
  void find_in_medium(int i, int depth);
  void choose_lights(int depth);
  void choose_other_light(int i, const EmitterChoice& choice, const Vec2& u);
  void sample_other_lights();
  LightSample sample_light(int i, const Vec3& from, const EmitterChoice& choice, const Vec2& u);
  void light_glossy();
  void queue_lights();
  void queue_near_lights();
  void queue_sky(const SkyVertex& vertex);
  void queue_glossy(const GlossyVertex& vertex);
  void queue_other_light(const SingleVertex& single);
  void queue_shadow(int i, const DirectLight& direct, double mis, const Vec3f& o, const Vec3f& w,
                    float length, MediumIndex medium);
  void queue_shadow(int i, const DirectLight& direct, double mis);
  void take_step(int depth, RayCounts& rays);
  bool scatter_lambertian(int i, int depth, WaveWalk& walk);
  bool scatter_glossy(int i, int depth, WaveWalk& walk);
  bool leave_mesh(int i, int depth, double pdf, WaveWalk& walk);
  /// The number for Russian roulette, if that may end a walk.
  double roulette(int i, int depth) const {
    return depth < rules_.rr_depth ? 0 : numbers_.read(at_.roulette, begin_ + i);
  }
  void scatter_in_lanes();
  bool scatter_other(int i, int depth, WaveWalk& walk, RayCounts& rays);

  /// The walk at this place of the wave, with its ray in double precision.
  WaveWalk& exact_walk(int place);
  WaveWalk& walk(int i) { return walks_[path_[begin_ + i]]; }
  Hit hits(int place) const { return hits_[place / RayPacket::size].hit(place % RayPacket::size); }
  bool passes_something(int place) const { return scene_->has_passages() && legs_.of(place); }
  const WaveLeg& leg(int place) const { return *legs_.of(place); }

  const Scene* scene_;
  PathRules rules_;
  MisExponent mis_;
  std::vector<WaveWalk> walks_;
  WaveShadows shadows_;
  Wave<uint32_t> shadow_emitter_;            ///< The emitter of each shadow ray.
  std::vector<LightToPass> lights_to_pass_;  ///< One for each shadow ray, if there are passages.

  bool keeps_emitters_ = false;
  std::vector<Part> parts_;
  Wave<int> last_part_;  ///< The last part of each path; -1: there is none.

  // Values of each path that takes this step:
  int live_ = 0;
  Wave<int> path_;    ///< Its index in walks_.
  VectorWave o_, d_;  ///< Its ray.
  Wave<bool> exact_;  ///< Whether its walk has the ray in double precision.
  WaveLegs legs_;     ///< The legs on which something is passed.
  PacketHits hits_[wave_size / RayPacket::size];
  Numbers numbers_;
  typename Numbers::Place leg_;  ///< The places of the numbers of this step.
  VertexNumbersOf<typename Numbers::Place> at_;
  int next_ = 0;  ///< How many take the next step; they are compacted.

  // Values of each path of the block:
  int begin_ = 0, count_ = 0;
  Block<uint32_t> emitter_;  ///< That which next-event estimation has chosen.
  /// The extinction where that is in a medium which glows: a walk may stop there (Arrival::flies).
  Block<Spectrum> light_stops_;
  Block<double> u_light_x_, u_light_y_, u_choice_, u_lobe_;
  LambertianVertices lambertian_;
  GlossyVertices glossy_;
  SingleVertices singles_;
  std::vector<SkyVertex> sky_vertices_;
  int sky_count_ = 0;              ///< How many are in use.
  Block<int> glossy_at_, single_;  ///< Index in glossy_ or singles_ of its vertex; -1: none.
  BackgroundPositions backgrounds_;
  bool near_lights_;  ///< Whether any vertex on a mesh samples a light that is not at infinity.
};

using PathWave = BasicPathWave<WaveNumbers>;

}  // namespace mlt
