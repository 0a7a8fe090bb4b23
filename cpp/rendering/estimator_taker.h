// Takes samples with an estimator (path/estimators.h), side by side where there is a wave for it.
#pragma once

#include "path/estimators.h"
#include "path/layered_sample.h"
#include "rendering/sampled_rendering.h"

namespace mlt {

/// The wave of estimators that have none.
struct NoWave {};

/// Adds the light of one sample to the image and to its layers of light.
class SampleLight {
 public:
  /// Light at the sample's own position, times own_scale, is radiance.
  SampleLight(const Vec2& raster, double own_scale, SampleSink& sink)
      : raster_(raster), own_scale_(own_scale), sink_(&sink), layers_(sink.finder().count()) {}
  /// Adds light with this weighted colour.
  void add(const ImageLight& light, const Color& rgb) {
    if (!light.own_pixel) return sink_->splat(light.raster, rgb, light.layers);
    own_pixel_ += rgb;
    for_each_layer(light.layers, [&](int i) { layers_[i] += rgb; });
  }
  void finish() {
    if (layers_.empty()) return sink_->add(raster_, own_pixel_ * own_scale_);
    for (Color& layer : layers_) layer *= own_scale_;
    sink_->add(raster_, own_pixel_ * own_scale_, layers_);
  }

 private:
  Vec2 raster_;
  double own_scale_;
  SampleSink* sink_;
  Color own_pixel_{0};
  std::vector<Color> layers_;
};

/// Samples of the image alone: their light is added as it is.
class ImageSum {
 public:
  explicit ImageSum(double own_scale) : own_scale_(own_scale) {}

  /// One sample.
  class Sample {
   public:
    Sample(const ImageSum& of, const Vec2& raster, SampleSink& sink)
        : light_(raster, of.own_scale_, sink) {}
    void add(const FoundLight& light) { light_.add(light, light.rgb); }
    void finish() { light_.finish(); }

   private:
    SampleLight light_;
  };

 private:
  double own_scale_;
};

/// `Sum` adds the light of samples to the image: Sum::Sample(sum, raster, sink) has add(light) and
/// finish(). `wave`: nullptr where it does not support the scene.
template <class Estimator, class Sum = ImageSum, class Wave = NoWave>
class EstimatorTaker : public SampleTaker {
 public:
  EstimatorTaker(Estimator estimator, Sum sum, std::unique_ptr<Wave> wave = nullptr)
      : estimator_(std::move(estimator)), sum_(std::move(sum)), wave_(std::move(wave)) {}

  void sample(const Vec2& raster, PixelSampler& sampler, SampleSink& sink,
              RayCounts& rays) override {
    typename Sum::Sample sample(sum_, raster, sink);
    const auto take = [&](const FoundLight& light) { sample.add(light); };
    if (sink.finder().count() > 0) {
      layered_(estimator_, raster, sampler, rays, sink.finder(), take);
    } else {
      estimator_.paths = sink.paths();
      estimator_(raster, sampler, rays, take);
    }
    sample.finish();
  }

  void sample_cells(const PixelRect& cells, const CellStreams& streams, SampleSink& sink,
                    RayCounts& rays) override {
    if constexpr (std::is_same_v<Wave, NoWave>) {
      SampleTaker::sample_cells(cells, streams, sink, rays);
    } else {
      if (!wave_ || !can_trace_wave(sink))
        return SampleTaker::sample_cells(cells, streams, sink, rays);
      for_each_packet_cell(cells, [&](const Vec2i& cell) {
        wave_->add(streams.stream(cell.x, cell.y), streams.index, cell);
        if (wave_->full()) trace_wave(streams.index.exposure, sink, rays);
      });
      trace_wave(streams.index.exposure, sink, rays);
    }
  }

 private:
  /// Whether waves tell all that the layers of light need.
  bool can_trace_wave(SampleSink& sink) {
    const LightLayers::Finder& finder = sink.finder();
    return !finder.tells_classes() && wave_->keep_emitters(finder.tells_lamps());
  }
  void trace_wave(int exposure, SampleSink& sink, RayCounts& rays) {
    if (wave_->size() == 0) return;
    wave_->trace(rays);
    for (int i = 0; i < wave_->size(); ++i) show(i, exposure, sink);
    wave_->clear();
  }
  void show(int i, int exposure, SampleSink& sink) {
    typename Sum::Sample sample(sum_, wave_->raster(i), sink);
    if (sink.finder().count() == 0)
      wave_->show_lights(i, [&](const FoundLight& light) { sample.add(light); });
    else
      wave_->show_lights(i, [&](FoundLight light) {
        light.layers = sink.finder().of(light.emitter, exposure);
        sample.add(light);
      });
    sample.finish();
  }

  Estimator estimator_;
  Sum sum_;
  std::unique_ptr<Wave> wave_;
  LayeredSample layered_;
};

/// Renders the image by an estimator alone.
template <class Estimator, class Wave = NoWave>
std::unique_ptr<SampleTaker> take_alone(Estimator estimator, std::unique_ptr<Wave> wave = nullptr) {
  const ImageSum sum(estimator.own_scale());
  return std::make_unique<EstimatorTaker<Estimator, ImageSum, Wave>>(std::move(estimator), sum,
                                                                     std::move(wave));
}

}  // namespace mlt
