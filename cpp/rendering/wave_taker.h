// Samples of path tracing, traced side by side; alone where they meet a surface that light passes,
// and in scenes with media.
#pragma once

#include "path/inspect.h"
#include "rendering/sampled_rendering.h"
#include "wave/path_wave.h"

namespace mlt {

class WaveTaker : public SampleTaker {
 public:
  WaveTaker(const Scene& scene, const PathRules& rules, Heuristic heuristic)
      : scene_(&scene), rules_(rules), wave_(scene, rules, heuristic) {}

  void sample_cells(const PixelRect& cells, const CellStreams& streams, SampleSink& sink,
                    RayCounts& rays) override {
    if (scene_->has_media()) return SampleTaker::sample_cells(cells, streams, sink, rays);
    for_each_packet_cell(cells, [&](const Vec2i& cell) {
      wave_.numbers().add(streams.stream(cell.x, cell.y), streams.index);
      rasters_.emplace_back(cell);
      if (rasters_.size() == PathWave::capacity) trace_wave(streams, sink, rays);
    });
    trace_wave(streams, sink, rays);
  }

 protected:
  const Scene& scene() const { return *scene_; }
  const PathRules& rules() const { return rules_; }

 private:
  virtual ChainFactor chain_factor(const Vec2& /*raster*/) const { return {}; }
  /// Records the radiance that a path has found.
  virtual void show(const Vec2& raster, const Color& radiance, SampleSink& sink) {
    sink.add(raster, radiance);
  }
  /// Traces the paths through all cells in rasters_.
  void trace_wave(const CellStreams& streams, SampleSink& sink, RayCounts& rays) {
    start_wave();
    wave_.trace(rays);
    for (size_t i = 0; i < wave_.size(); ++i)
      if (wave_.is_left(i))
        sample_cell(Vec2i(glm::floor(rasters_[i])), streams, sink, rays);
      else
        show(rasters_[i], wave_.radiance(i), sink);
    wave_.clear();
    rasters_.clear();
  }

  /// Starts the paths with the random numbers that sample() takes.
  void start_wave() {
    const Camera& camera = scene_->camera();
    const Shutter& shutter = camera.shutter();
    WaveNumbers& numbers = wave_.numbers();
    numbers.read2(numbers.places().next2(), 0, numbers.count(), &u_x_[0], &u_y_[0]);
    for (size_t i = 0; i < rasters_.size(); ++i) rasters_[i] += Vec2(u_x_[i], u_y_[i]);
    const auto at = LensNumbersOf<WaveNumbers::Place>::draw(numbers.places());
    if (!camera.delta_position())
      numbers.read2(at.position, 0, numbers.count(), &u_x_[0], &u_y_[0]);
    if (shutter.open != shutter.close) numbers.read(at.time, 0, numbers.count(), &u_time_[0]);
    if (camera.spectral())
      numbers.read(numbers.places().next(), 0, numbers.count(), &u_spectral_[0]);
    for (size_t i = 0; i < rasters_.size(); ++i) {
      Ray ray = camera.ray(rasters_[i], {u_x_[i], u_y_[i]}, camera.time(u_time_[i]));
      ray.wavelength = camera.wavelength([&] { return u_spectral_[i]; });
      wave_.add(ray, chain_factor(rasters_[i]));
    }
  }

  const Scene* scene_;
  PathRules rules_;
  PathWave wave_;
  std::vector<Vec2> rasters_;  ///< Raster positions of the wave's paths; at first, their cells.
  Wave<double> u_x_, u_y_, u_time_, u_spectral_;
};

}  // namespace mlt
