// Samples of bidirectional path tracing that are traced side by side: their subpaths, and all
// connections of one technique (s, t). Each sample is that of BidirectionalSampler, up to
// rounding.
// D. van Antwerpen, "Improving SIMD efficiency for parallel Monte Carlo light transport on the
// GPU", High-Performance Graphics 2011.
#pragma once

#include "base/whole_vectors.h"
#include "path/bidirectional_sampler.h"
#include "path/found_light.h"
#include "wave/subpath_wave.h"
#include "wave/wave_shadows.h"

namespace mlt {

class BidirectionalWave {
 public:
  static constexpr int capacity = SubpathWave::capacity;

  /// Whether all lights are emissive meshes, the camera has no aperture, and nothing moves.
  static bool supports(const Scene& scene, const BidirectionalSettings& settings);
  /// Requires supports(scene, settings).
  BidirectionalWave(const Scene& scene, const BidirectionalSettings& settings);

  /// Adds a sample with the numbers of PixelSampler(stream, index): the first two are its position
  /// in this pixel.
  void add(uint64_t stream, uint32_t index, const Vec2& pixel);
  int size() const { return numbers_.count(); }
  bool full() const { return size() == capacity; }
  /// Traces all samples.
  void trace(RayCounts& rays);
  void clear();

  // The results of the samples:
  const Vec2& raster(int i) const { return rasters_[i]; }
  /// Calls show(FoundLight) for all light that the i-th sample has found. With the balance
  /// heuristic f / P is the weighted f / p of a path, without roulette. All surfaces are
  /// Lambertian, so that only the directly visible lights are certain.
  template <class Show>
  void show_lights(int i, Show&& show) const {
    for (int k = first_[i]; k >= 0; k = lights_found_[k].next) {
      const Light& light = lights_found_[k];
      show(FoundLight{{light.raster, light.weighted, light.own_pixel},
                      light.survival,
                      light.edges == 1 ? 1. : 0.});
    }
  }
  /// Whether the i-th sample has to be taken by BidirectionalSampler; it has no results then.
  bool fell_back(int i) const { return camera_.fell_back(i); }

 private:
  /// Light that a sample has found.
  struct Light {
    int sample;
    int edges;        ///< Of its path.
    bool own_pixel;   ///< Whether t >= 2: at the raster position of the sample.
    double survival;  ///< Probability that its walks have survived Russian roulette.
    Vec2 raster;
    Color weighted;  ///< f w / p.
    int next = -1;   ///< The sample's next light; -1: there is none.
  };
  template <class T>
  using Samples = SubpathWave::Samples<T>;
  static constexpr int blocks = capacity / JointLanes::size;
  int block_count() const { return whole_vectors(size()) / JointLanes::size; }

  void walk_from_camera(RayCounts& rays);
  void walk_from_lights(RayCounts& rays);
  void start_at_lights(const LightNumbersOf<WaveNumbers::Place>& at, int begin, int count);
  void fall_back_together();
  void take_hits();
  int add(const Light& light);
  void take(int light);
  void draw_wavelengths();
  /// How many lanes of a spectrum differ.
  int lanes() const { return scene_->camera().spectral() ? 4 : 3; }
  void choose_direct(int place);
  void choose_direct(int place, int block, int first);
  void connect(int s, int t, RayCounts& rays);
  void connect_to_lens(int s, RayCounts& rays);
  void make_room_for_shadows(RayCounts& rays);
  void wait_for_shadow(const Light& light, const Vec3f& o, const Vec3f& w, float length);
  void connect_to_lens(int s, int block);
  const JointLanes& light_joints(int s, int block) const {
    return s == 1 ? direct_[block] : light_.joints(s - 1, block);
  }
  const Lanes<double, JointLanes::size>& own(int s, int block) const {
    return s == 1 ? direct_own_[block] : one_;
  }
  bool light_reaches(int s, int block) const { return s == 1 || light_.reaches(s - 1, block); }
  void find_shadows(RayCounts& rays);

  const Scene* scene_;
  BidirectionalSettings settings_;
  MisExponent beta_;
  PositionSample lens_;
  SubpathWave camera_, light_;
  WaveNumbers numbers_;
  WaveNumbers::Place direct_places_;  ///< Places of the next numbers for s = 1.
  Samples<Vec2> rasters_;
  Samples<int> first_, last_;        ///< Each sample's first and last light; -1: there is none.
  std::vector<Light> lights_found_;  ///< Those that no sample links to are in shadow.
  Samples<double> u_x_, u_y_, u_choice_;
  Samples<double> wavelength_;  ///< See wavelengths.h.
  LambertianVertices lights_;   ///< Points on lights, for a block of samples.
  JointLanes direct_[blocks];   ///< Points on lights for s = 1, sampled for the camera vertex.
  /// See join(); for s = 1, and for other techniques.
  Lanes<double, JointLanes::size> direct_own_[blocks], one_{1, 1, 1, 1, 1, 1, 1, 1};
  WaveShadows shadows_;
};

}  // namespace mlt
