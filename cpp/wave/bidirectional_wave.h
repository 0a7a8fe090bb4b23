// Samples of bidirectional path tracing that are traced side by side: their subpaths, and all
// connections of one technique (s, t). Each sample is that of BidirectionalSampler, up to
// rounding. Joints of vertices that are not Lambertian are computed one by one.
// D. van Antwerpen, "Improving SIMD efficiency for parallel Monte Carlo light transport on the
// GPU", High-Performance Graphics 2011.
#pragma once

#include "base/whole_vectors.h"
#include "path/background_positions.h"
#include "path/bidirectional_sampler.h"
#include "path/found_light.h"
#include "path/joined_edge.h"
#include "wave/subpath_wave.h"
#include "wave/wave_shadows.h"

#include <memory>

namespace mlt {

/// The techniques of bidirectional path tracing that a wave uses.
enum class Techniques {
  all,
  to_lens,  ///< t = 1 alone, whose weight is then 1: light tracing (LightEstimator).
};

class BidirectionalWave {
 public:
  static constexpr int capacity = SubpathWave::capacity;

  /// Whether all media of the scene are grey, and the settings ask for waves, for next-event
  /// estimation, for no manifold samples and for a heuristic with an exponent.
  static bool supports(const Scene& scene, const BidirectionalSettings& settings);
  /// A wave, or nullptr where it does not support that.
  static std::unique_ptr<BidirectionalWave> where_supported(
      const Scene& scene, const BidirectionalSettings& settings,
      Techniques techniques = Techniques::all) {
    if (!supports(scene, settings)) return nullptr;
    return std::make_unique<BidirectionalWave>(scene, settings, techniques);
  }
  /// Requires supports(scene, settings).
  BidirectionalWave(const Scene& scene, const BidirectionalSettings& settings,
                    Techniques techniques = Techniques::all);

  /// Adds a sample with the numbers of PixelSampler(stream, index): the first two are its position
  /// in the cell with this corner.
  void add(uint64_t stream, const SampleIndex& index, const Vec2& corner);
  /// The size of the cells; by default that of a pixel.
  void set_cell(const Vec2& size) { cell_ = size; }
  int size() const { return numbers_.count(); }
  bool full() const { return size() == capacity; }
  /// Traces all samples.
  void trace(RayCounts& rays);
  void clear();

  /// Lights always tell their emitters.
  bool keep_emitters(bool /*keep*/) { return true; }

  // The results of the samples:
  const Vec2& raster(int i) const { return rasters_[i]; }
  /// Calls show(FoundLight) for all light that the i-th sample has found. With the balance
  /// heuristic f / P is the weighted f / p of a path, without roulette.
  template <class Show>
  void show_lights(int i, Show&& show) const {
    for (int k = first_[i]; k >= 0; k = lights_found_[k].next) {
      const Light& light = lights_found_[k];
      FoundLight found{{light.raster, light.weighted, light.own_pixel},
                       light.survival,
                       light.certainty,
                       light.joint};
      found.emitter = light.emitter;
      show(found);
    }
  }

 private:
  /// Light that a sample has found.
  struct Light {
    int sample;
    bool own_pixel;              ///< At the raster position of the sample.
    double survival, certainty;  ///< See Connection.
    Vec2 raster;
    Color weighted{0};  ///< f w / p.
    int joint = 0;      ///< See FoundLight.
    uint32_t emitter = 0;
    int next = -1;  ///< The sample's next light; -1: there is none.
  };
  /// Light on a shadow ray, as if there were no media and surfaces that it may have to pass. The
  /// sums are those of SubpathWave::Hit.
  struct Waiting {
    Spectrum weighted;  ///< f w / p.
    bool dispersed;
    double scaled, fixed;
    MediumIndex medium;  ///< In which the ray starts.
  };
  template <class T>
  using Samples = SubpathWave::Samples<T>;
  static constexpr int blocks = capacity / JointLanes::size;
  int block_count() const { return whole_vectors(size()) / JointLanes::size; }

  /// The light if it is an emissive mesh all of whose rays start in its surroundings.
  const MeshLight& mesh_light(uint32_t index) const {
    return scene_->starts_in_surroundings(index) ? scene_->mesh_light(index) : other_light_;
  }
  void start_samples();
  void draw_lens();
  void walk_from_camera(RayCounts& rays);
  void walk_from_lights(RayCounts& rays);
  void start_at_lights(const LightNumbersOf<WaveNumbers::Place>& at, int begin, int count);
  void start_at_other_light(int i, const EmitterChoice& choice, const Vec2& u_direction);
  void take_hits(RayCounts& rays);
  int add(const Light& light);
  void take(int light);
  /// How many lanes of a spectrum differ.
  int lanes() const { return scene_->camera().spectral() ? 4 : 3; }
  void choose_direct(int place);
  void choose_direct(int place, int block, int first);
  void choose_other_direct(int i, const Vec3& from, const EmitterChoice& choice);
  void take_other_direct(int i, const LightSample& light);
  void take_infinite_direct(int i, const LightSample& light);
  void connect(int s, int t, RayCounts& rays);
  void connect_to_lens(int s, RayCounts& rays);
  void connect_to_lens(int s, int block);
  const JointLanes& lens_joints(int block);
  void join_alone(int s, int sample, const JointLanes& a, const JointLanes& b);
  double sums(const JointLanes& joints, int lane, double back) const {
    return joints.single[lane] ? joints.single[lane]->sums(beta_, back) : joints.sums[lane];
  }
  void make_room_for_shadows(RayCounts& rays);
  [[gnu::always_inline]] void wait_for_shadow(const Light& light, const Waiting& waiting,
                                              const Vec3f& o, const Vec3f& w, float length);
  void pass(int shadow, bool surfaces);
  const SingleWalkVertex& lens(int sample) const { return lenses_[one_lens_ ? 0 : sample]; }
  double time(int sample) const { return lens(sample).x.vertex.at.time; }
  const JointLanes& light_joints(int s, int block) const {
    return s == 1 ? direct_[block] : light_.joints(s - 1, block);
  }
  const JointTechnique& technique(int s, int block) const {
    return s == 1 ? direct_technique_[block] : joins_walks_;
  }
  bool light_reaches(int s, int block) const { return s == 1 || light_.reaches(s - 1, block); }
  void find_shadows(RayCounts& rays);

  const Scene* scene_;
  BidirectionalSettings settings_;
  Techniques techniques_;
  MisExponent beta_;
  bool one_lens_;  ///< Whether all samples have the same position on the lens, and the same time.
  std::vector<SingleWalkVertex> lenses_;
  MeshLight other_light_;  ///< Stands for lights that are no such mesh.
  SubpathWave camera_, light_;
  WaveNumbers numbers_;
  WaveNumbers::Place direct_places_;  ///< Places of the next numbers for s = 1.
  Vec2 cell_{1};
  int joint_ = 0;                                       ///< That of the light that is being added,
  const Samples<uint32_t>* emitters_ = &walk_emitter_;  ///< and the emitter of each sample.
  Samples<uint32_t> walk_emitter_, direct_emitter_;     ///< Where walks start, and for s = 1.
  Samples<Vec2> rasters_;
  Samples<int> first_, last_;        ///< Each sample's first and last light; -1: there is none.
  std::vector<Light> lights_found_;  ///< One to which no sample links is in shadow.
  Samples<double> u_x_, u_y_, u_choice_, u_time_;
  Samples<double> wavelength_;  ///< See wavelengths.h.
  LambertianVertices lights_;   ///< Points on lights, for a block of samples.
  JointLanes direct_[blocks];   ///< Points on lights for s = 1, sampled for the camera vertex.
  SingleWalkVertices singles_;  ///< Points on lights that are no emissive meshes.
  BackgroundPositions backgrounds_;
  /// Their positions, while others are chosen for the same camera vertex.
  struct OtherDirect {
    int sample;
    LightSample light;
  };
  std::vector<OtherDirect> other_direct_;
  int other_direct_count_ = 0;  ///< How many are in use.
  JointLanes lens_joints_;
  WalkVertex scratch_[2];                    ///< See single_vertex().
  JointTechnique direct_technique_[blocks];  ///< For s = 1,
  JointTechnique joins_walks_;               ///< and for s > 1.
  WaveShadows shadows_;
  std::vector<Waiting> waiting_;  ///< One for each shadow ray, if there are passages.
};

}  // namespace mlt
