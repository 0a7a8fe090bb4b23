// Subpaths of many samples that are traced side by side. Each is that of Subpath, up to rounding.
// Vertices that are not Lambertian are computed one by one.
#pragma once

#include "path/path_rules.h"
#include "path/ray_counts.h"
#include "path/subpath.h"
#include "wave/joint_lanes.h"
#include "wave/wave_hits.h"
#include "wave/wave_legs.h"
#include "wave/wave_numbers.h"

namespace mlt {

class SubpathWave {
 public:
  static constexpr int capacity = 256;
  template <class T>
  using Samples = Lanes<T, capacity>;

  /// A path that a walk has made alone: a camera walk has hit a light (s = 0), or a light walk the
  /// lens (t = 0).
  struct Hit {
    int sample;
    Spectrum light;  ///< f / p.
    /// The sums over the other techniques (TechniqueSums): over those that make the edge to the
    /// lens by a walk which passes what lies between, and over the rest.
    double scaled, fixed;
    bool dispersed;
    double survival, certainty;  ///< See Connection.
    uint32_t emitter;            ///< Where the light comes from; unknown of walks from a light.
    // For the lens alone:
    Vec2 raster{};
    Ray to_lens{};  ///< It has still to be seen.
  };

  /// `light_image`: whether techniques with t <= 1 count.
  SubpathWave(const Scene& scene, const PathRules& rules, Subpath::From from, Heuristic heuristic,
              bool light_image);

  void clear();
  /// A step of a walk: where it leaves a vertex.
  struct Step {
    int sample;
    Vec3 p;  ///< Position of the vertex; o, w: the ray from there.
    Vec3f o, w;
    float cosine;                        ///< |w.ng| at the vertex.
    float pdf;                           ///< Density of w in solid angle.
    double forward, sums;                ///< See JointLanes; the sums are for a walk that goes on.
    Spectrum throughput;                 ///< Throughput of the next vertex.
    double survival = 1, certainty = 1;  ///< See Connection.
    bool delta = false;                  ///< Whether the vertex scatters by a delta lobe.
    bool dispersed = false;              ///< Whether a vertex so far disperses.
    MediumIndex medium = no_medium;      ///< In which its ray starts.
  };
  /// A walk begins with a step from the lens,
  void start(const Step& first, const Ray& ray);
  /// from a triangle of an emissive mesh,
  void start(const Step& first, double time, double wavelength, uint32_t light, uint32_t triangle);
  /// or from another light.
  void start(const Step& first, const Ray& ray, const SingleWalkVertex& light);
  /// Walks all subpaths to their ends, with `most` vertices at most. The next of the `numbers` are
  /// those after the first step.
  void walk(const WaveNumbers& numbers, int most, RayCounts& rays);

  /// Vertices at this place (1: the first after the end) of eight samples.
  const JointLanes& joints(int place, int block) const { return joints_[place * blocks + block]; }
  /// Whether any of eight samples can be joined at the place.
  bool reaches(int place, int block) const { return longest_[block] >= place; }
  int last_place() const { return last_place_; }
  const std::vector<Hit>& hits() const { return hits_; }

 private:
  static constexpr int blocks = capacity / JointLanes::size;

  void open(int place);
  void find_hits(bool coherent, RayCounts& rays);
  void follow_legs(RayCounts& rays);

  // Functions of the `count_` walks from the begin_-th one on:
  void shade(int place, bool goes_on, RayCounts& rays);
  void find_vertices(int place);
  void find_vertex(int i, int place);
  bool is_in_lanes(uint32_t shape, const WaveLeg* leg) const;
  void find_behind(int i, int place, const WaveLeg& leg);
  [[gnu::always_inline]] void find_on_surface(int i, int place, const mlt::Hit& hit,
                                              const WaveLeg* leg);
  void find_other(int i, int place);
  void find_in_medium(int i, int place, const WaveLeg& leg);
  void add_single(int i, const SurfacePoint& at);
  bool pass(int i, int place, const SurfacePoint* at) {
    return !scene_->has_passages() || pass_leg(i, place, at);
  }
  bool pass_leg(int i, int place, const SurfacePoint* at);
  void find_techniques(int place);
  void arrive();
  void arrive_alone();
  void keep_lambertian(int i, int place);
  void keep_other(int i, int place);
  JointLanes& joint(int i, int place, int lane);
  void take_steps(int place, RayCounts& rays);
  void scatter_lambertian(int i, int place);
  void scatter_other(int i, int place, RayCounts& rays);
  double survive(int i, int place, double ratio);

  // Functions of one walk:
  void start(const Step& first, double time, double wavelength);
  void set(int walk, const Step& step);
  void set(int walk, const Ray& ray);
  void set_back(int walk, const SurfacePoint& from);
  void leave_scene(int walk, int place);
  void find_light(int walk, int place, const SurfacePoint& at);
  void hit_light(const Emitter& emitter, int walk, int place, const SurfacePoint& at);
  void hit_lens(int walk, int place);
  double direct_technique(int walk, const SurfacePoint& from) const;
  /// Whether some technique joins a vertex at this place to the one before it.
  bool can_join_before(int walk, int place) const {
    return (from_light_ || place > 1 || light_image_) && !delta_[walk];
  }
  /// Its ray in double precision.
  const Ray& exact_ray(int walk);
  void find_surface_point(int walk, SurfacePoint& at);
  mlt::Hit hit(int walk) const {
    return found_[walk / RayPacket::size].hit(walk % RayPacket::size);
  }
  /// The way to its next vertex; nullptr: it passes nothing there.
  const WaveLeg* leg(int walk) const { return scene_->has_passages() ? legs_.of(walk) : nullptr; }
  /// |p - q|^2 for its last vertex q; 1 if that is at infinity.
  double distance2(int walk, const Vec3& p) const {
    return near_[walk] == 0 ? 1 : length_squared(p - previous_[walk]);
  }

  JointLanes& at(int place, int block) { return joints_[place * blocks + block]; }

  const Scene* scene_;
  PathRules rules_;
  bool from_light_, light_image_;
  bool meets_lens_;  ///< Whether the walks may hit the lens.
  MisExponent beta_;
  std::vector<JointLanes> joints_;
  SingleWalkVertices singles_;  ///< Single vertices that are joined.
  Lanes<int, blocks> longest_;  ///< Last place of the samples of each block.
  int last_place_ = 0;
  std::vector<Hit> hits_;

  // Values of each sample:
  Samples<double> time_, wavelength_, start_forward_;  ///< The density of vertex 0.

  // Values of each walk at its start:
  Samples<uint32_t> light_, triangle_;
  Samples<const SingleWalkVertex*> single_light_;  ///< nullptr: it starts on an emissive mesh.

  // Values of each walk that takes this step (see Step):
  int live_ = 0;
  Samples<int> sample_;
  VectorLanes<capacity> o_, d_, p_;
  Samples<Vec3> previous_;  ///< Its last vertex, of which p_ is rounded.
  Samples<float> cosine_, pdf_;
  Samples<double> forward_, sums_, survival_, certainty_;
  Samples<Spectrum> throughput_;
  Samples<bool> delta_, dispersed_;
  Samples<float> near_;         ///< 0 if its last vertex is at infinity, else 1.
  Samples<double> stops_back_;  ///< See WalkVertex::passes_back, of its last vertex.
  Samples<MediumIndex> medium_;
  WaveLegs legs_;     ///< The legs on which something is passed.
  Samples<Ray> ray_;  ///< See exact_ray(); not known unless `exact_`.
  Samples<bool> exact_;
  PacketHits found_[capacity / RayPacket::size];
  WaveNumbers numbers_;
  WaveNumbers::Place leg_;  ///< The places of the numbers of this step.
  StepNumbersOf<WaveNumbers::Place> at_;
  int next_ = 0;  ///< How many take the next step; they are compacted.

  // Values of each walk of the block:
  int begin_ = 0, count_ = 0;
  LambertianVertices lambertian_;
  SingleWalkVertices passed_;        ///< Vertices that no path is joined to.
  Block<SingleWalkVertex*> single_;  ///< nullptr: its vertex is Lambertian, or there is none.
  Block<float> cosine_to_previous_;  ///< See JointLanes.
  Block<float> next_cosine_;         ///< |w.ng| of the sampled direction.
  Block<float> light_factor_;        ///< |w.ns| / |w.ng| of the direction to the previous vertex.
  Block<double> forward_here_, sums_here_;
  Block<Spectrum> transmitted_;  ///< See WalkVertex::passed; where there are passages.
  Block<double> G_;              ///< Between the vertex and the previous one.
  Block<double> technique_;      ///< How often the technique with its joint before counts.
};

}  // namespace mlt
