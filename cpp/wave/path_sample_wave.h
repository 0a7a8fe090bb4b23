// Samples of path tracing (PathEstimator), traced side by side.
#pragma once

#include "path/found_light.h"
#include "wave/path_wave.h"

#include <functional>
#include <memory>
#include <vector>

namespace mlt {

class PathSampleWave {
 public:
  using WeightsAt = std::function<PathWeights(const Vec2& raster)>;

  /// A wave, or nullptr where the rules want none. With `weights` the light of a sample counts with
  /// its weights beside chains.
  static std::unique_ptr<PathSampleWave> where_wanted(const Scene& scene, const PathRules& rules,
                                                      Heuristic heuristic,
                                                      WeightsAt weights = nullptr) {
    if (!rules.waves || scene.camera().clips_far()) return nullptr;
    if (rules.equiangular && scene.has_media()) return nullptr;
    if (rules.through_boundaries && RefractedLight::serves(scene)) return nullptr;
    return std::make_unique<PathSampleWave>(scene, rules, heuristic, std::move(weights));
  }
  PathSampleWave(const Scene& scene, const PathRules& rules, Heuristic heuristic,
                 WeightsAt weights = nullptr)
      : scene_(&scene), wave_(scene, rules, heuristic), weights_(std::move(weights)) {}

  /// Adds a sample with the numbers of PixelSampler(stream, index): the first two are its position
  /// in this pixel.
  void add(uint64_t stream, const SampleIndex& index, const Vec2& pixel) {
    wave_.numbers().add(stream, index);
    rasters_.push_back(pixel);
  }
  int size() const { return static_cast<int>(rasters_.size()); }
  bool full() const { return rasters_.size() == PathWave::capacity; }
  void trace(RayCounts& rays) {
    start();
    wave_.trace(rays);
  }
  const Vec2& raster(int i) const { return rasters_[i]; }
  /// Whether lights tell their emitters, if they can.
  bool keep_emitters(bool keep) {
    wave_.keep_emitters(keep);
    return wave_.keeps_emitters() == keep;
  }
  /// Calls show(light) for the light that the i-th sample has found: once for all, or for each path
  /// with its emitter.
  template <class Show>
  void show_lights(int i, Show&& show) const {
    if (!wave_.keeps_emitters()) return show(FoundLight{{rasters_[i], wave_.radiance(i), true}});
    wave_.show_emitters(i, [&](uint32_t emitter, const Color& rgb) {
      FoundLight light{{rasters_[i], rgb, true}};
      light.emitter = emitter;
      show(light);
    });
  }
  void clear() {
    wave_.clear();
    rasters_.clear();
  }

 private:
  /// Starts the paths with the random numbers that PathEstimator takes.
  void start() {
    const Camera& camera = scene_->camera();
    const Shutter& shutter = camera.shutter();
    WaveNumbers& numbers = wave_.numbers();
    numbers.read2(numbers.places().next2(), 0, numbers.count(), &u_x_[0], &u_y_[0]);
    for (int i = 0; i < size(); ++i) rasters_[i] += Vec2(u_x_[i], u_y_[i]);
    // What the camera does not ask for keeps other numbers.
    const auto at = LensNumbersOf<WaveNumbers::Place>::draw(numbers.places());
    if (!camera.delta_position())
      numbers.read2(at.position, 0, numbers.count(), &u_x_[0], &u_y_[0]);
    const bool moves = shutter.opens();
    if (moves) numbers.read(at.time, 0, numbers.count(), &u_time_[0]);
    if (camera.spectral())
      numbers.read(numbers.places().next(), 0, numbers.count(), &u_spectral_[0]);
    for (int i = 0; i < size(); ++i) {
      const double time = moves ? camera.time(u_time_[i]) : shutter.open;
      Ray ray = camera.ray(rasters_[i], {u_x_[i], u_y_[i]}, time);
      ray.medium = camera.surroundings();
      ray.wavelength = camera.wavelength([&] { return u_spectral_[i]; });
      wave_.add(ray, weights_ ? weights_(rasters_[i]) : PathWeights());
    }
  }

  const Scene* scene_;
  PathWave wave_;
  WeightsAt weights_;
  std::vector<Vec2> rasters_;  ///< Raster positions of the samples; at first, their pixels.
  Wave<double> u_x_, u_y_, u_time_, u_spectral_;
};

}  // namespace mlt
