// Samples of bidirectional path tracing, traced side by side where BidirectionalWave serves the
// scene.
#pragma once

#include "rendering/sampled_rendering.h"
#include "wave/bidirectional_wave.h"

namespace mlt {

class BidirectionalTaker : public SampleTaker {
 public:
  /// `side_by_side`: whether to use waves where they serve the scene.
  BidirectionalTaker(const Scene& scene, const BidirectionalSettings& settings,
                     bool side_by_side = true) {
    if (side_by_side && BidirectionalWave::supports(scene, settings))
      wave_ = std::make_unique<BidirectionalWave>(scene, settings);
  }

  void sample_cells(const PixelRect& cells, const CellStreams& streams, SampleSink& sink,
                    RayCounts& rays) override {
    if (!wave_) return SampleTaker::sample_cells(cells, streams, sink, rays);
    for_each_packet_cell(cells, [&](const Vec2i& cell) {
      if (!wave_worthwhile_) return sample_cell(cell, streams, sink, rays);
      wave_->add(streams.stream(cell.x, cell.y), streams.index, cell);
      cells_.push_back(cell);
      if (wave_->full()) trace_wave(streams, sink, rays);
    });
    trace_wave(streams, sink, rays);
  }

 private:
  /// Adds the lights of the i-th sample of a wave to the image.
  virtual void show(const BidirectionalWave& wave, int i, SampleSink& sink) = 0;

  void trace_wave(const CellStreams& streams, SampleSink& sink, RayCounts& rays) {
    int left = 0;
    wave_->trace(rays);
    for (int i = 0; i < wave_->size(); ++i) {
      if (wave_->fell_back(i))
        sample_cell(cells_[i], streams, sink, rays);
      else
        show(*wave_, i, sink);
      left += wave_->fell_back(i);
    }
    wave_worthwhile_ = 2 * left <= wave_->size();
    wave_->clear();
    cells_.clear();
  }

  std::unique_ptr<BidirectionalWave> wave_;  ///< nullptr if it does not serve the scene.
  std::vector<Vec2i> cells_;                 ///< Cells of the samples in the wave.
  bool wave_worthwhile_ = true;              ///< Unless most samples of the last one were left.
};

}  // namespace mlt
