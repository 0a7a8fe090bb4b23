// Subpaths of many samples that are traced side by side, among surfaces that are Lambertian and
// lights that are emissive meshes. Each is that of Subpath, up to rounding. Samples with subpaths
// that hit another kind of surface, or are very long, are left to Subpath.
#pragma once

#include "path/path_rules.h"
#include "path/ray_counts.h"
#include "path/subpath.h"
#include "wave/joint_lanes.h"
#include "wave/wave_numbers.h"

namespace mlt {

class SubpathWave {
 public:
  static constexpr int capacity = 256;
  static constexpr int most_vertices = 32;
  template <class T>
  using Samples = Lanes<T, capacity>;

  /// Light that a camera walk has hit: the technique s = 0.
  struct Hit {
    int sample;
    int place;  ///< Of the vertex on the light.
    Spectrum weighted;
    double survival;  ///< See JointLanes.
  };

  /// `light_image`: whether vertex 1 of a camera walk can be joined to the lens.
  SubpathWave(const Scene& scene, const PathRules& rules, Subpath::From from, Heuristic heuristic,
              bool light_image);

  /// Clears all subpaths; there are `count` samples now.
  void clear(int count);
  /// The first step of a sample's walk.
  struct Start {
    Vec3f p;  ///< Position of vertex 0; o, w: the ray from there.
    Vec3f o, w;
    float cosine;                      ///< |w.ng| at vertex 0.
    float pdf;                         ///< Density of w in solid angle.
    double forward, sums;              ///< See JointLanes.
    Spectrum throughput;               ///< Throughput of vertex 1.
    double wavelength;                 ///< See wavelengths.h.
    uint32_t light = 0, triangle = 0;  ///< Of a walk from a light: where on which it starts.
  };
  void start(int sample, const Start& start);
  /// Walks all subpaths to their ends, with `most` vertices at most. The next of the `numbers` are
  /// those after the first step.
  void walk(const WaveNumbers& numbers, int most, RayCounts& rays);

  /// Vertices at this place (1: the first after the end) of eight samples.
  const JointLanes& joints(int place, int block) const { return joints_[place * blocks + block]; }
  /// Whether any of eight samples can be joined at the place.
  bool reaches(int place, int block) const { return longest_[block] >= place; }
  int last_place() const { return last_place_; }
  /// Whether the sample has to be traced by itself.
  bool fell_back(int sample) const { return fell_back_[sample]; }
  /// Marks the sample to be traced by itself: nothing is joined to its vertices.
  void fall_back(int sample);
  const std::vector<Hit>& hits() const { return hits_; }

 private:
  static constexpr int blocks = capacity / JointLanes::size;

  void open(int place);
  void find_hits(bool coherent, RayCounts& rays);

  // Functions of the `count_` walks from the begin_-th one on:
  void shade(int place, bool last);
  void find_vertex(int i);
  void find_techniques(int place);
  void arrive();
  void hit_light(int i, int place);
  void keep(int i, int place);
  void take_steps(int place);
  double survive(int i, int place, double ratio);
  double direct_technique(uint32_t light, uint32_t triangle, const Vec3f& p) const;

  JointLanes& at(int place, int block) { return joints_[place * blocks + block]; }

  const Scene* scene_;
  PathRules rules_;
  bool from_light_, light_image_;
  MisExponent beta_;
  std::vector<JointLanes> joints_;
  Lanes<int, blocks> longest_;  ///< Last place of the samples of each block.
  int last_place_ = 0;
  Samples<bool> fell_back_;
  std::vector<Hit> hits_;

  // Values of each walk that takes this step:
  int live_ = 0;
  Samples<int> sample_;
  VectorLanes<capacity> o_, d_;  ///< Its ray.
  VectorLanes<capacity> p_;      ///< Its last vertex; below, the values of Start for it.
  Samples<float> cosine_, pdf_;
  Samples<double> forward_, sums_, survival_;
  Samples<Spectrum> throughput_;
  Samples<double> wavelength_;
  Samples<uint32_t> light_, triangle_;
  PacketHits found_[capacity / RayPacket::size];
  WaveNumbers numbers_;
  StepNumbersOf<WaveNumbers::Place> at_;  ///< The places of the numbers of this step.
  int next_ = 0;                          ///< How many take the next step; they are compacted.

  // Values of each walk of the block:
  int begin_ = 0, count_ = 0;
  LambertianVertices lambertian_;
  Block<bool> emits_;
  Block<float> cosine_to_previous_;  ///< See JointLanes.
  Block<float> next_cosine_;         ///< |w.ng| of the sampled direction.
  Block<float> light_factor_;        ///< |w.ns| / |w.ng| of the direction to the previous vertex.
  Block<double> forward_here_, reverse_emission_, sums_here_;
  Block<double> technique_;  ///< See find_techniques().
};

}  // namespace mlt
