// bdpt: bidirectional path tracing with all techniques (s, t) and multiple importance sampling.
// E. Lafortune and Y. Willems, "Bi-directional path tracing", Compugraphics 1993; E. Veach and L.
// Guibas, "Bidirectional estimators for light transport", EGWR 1994; Veach 1997, ch. 10.
#include "integrator/parameters.h"
#include "path/technique_names.h"
#include "rendering/sampled_rendering.h"
#include "wave/bidirectional_wave.h"

namespace mlt {
namespace {

struct BdptSettings {
  BidirectionalSettings paths;
  bool techniques = false, manifolds = false;
};

class BdptTaker : public SampleTaker {
 public:
  static BdptSettings settings(Params& params) {
    const BdptSettings settings{bidirectional_settings(params), params.boolean("techniques"),
                                params.boolean("manifolds")};
    if (settings.manifolds && !settings.paths.light_image)
      params.fail("manifolds", "needs light_image");
    if (settings.techniques &&
        (settings.paths.rules.max_depth < 0 || settings.paths.rules.max_depth > 16))
      params.fail("techniques",
                  "needs a max_depth from 1 to 16: it keeps an image for each technique");
    return settings;
  }
  static BdptSettings prepared(BdptSettings settings, const Scene& scene) {
    if (settings.manifolds) settings.paths.manifolds = learn_manifolds(scene, settings.paths.rules);
    return settings;
  }
  /// The lecture's table of strategies: layers "raw.s0.t2", "weighted.s0.t2", "raw.s1.t1", ...
  static SampledSettings film(const BdptSettings& settings) {
    SampledSettings film{true};
    if (settings.techniques)
      for (const std::string& name : technique_names(settings.paths.rules.max_depth))
        for (const char* kind : {"raw.", "weighted."}) film.layers.push_back(kind + name);
    return film;
  }
  BdptTaker(const Scene& scene, const BdptSettings& settings)
      : scene_(&scene),
        scale_(radiance_scale(scene)),
        bidirectional_(scene, settings.paths),
        techniques_(settings.techniques) {
    if (!techniques_ && BidirectionalWave::supports(scene, settings.paths))
      wave_ = std::make_unique<BidirectionalWave>(scene, settings.paths);
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

  void sample(const Vec2& raster, PixelSampler& sampler, SampleSink& sink,
              RayCounts& rays) override {
    bidirectional_.sample(raster, sampler, rays);
    Color seen(0);
    bidirectional_.connect_all(rays, [&](const Connection& c) {
      const Color weighted = c.contribution * c.weight;
      if (c.t >= 2)
        seen += weighted;
      else
        sink.splat(c.raster, weighted);
      if (std::vector<FoundPath>* paths = sink.paths())
        paths->push_back(found_path(*scene_, bidirectional_, c));
      if (!techniques_) return;
      const int layer = 2 * technique_index(c.s, c.t);
      sink.splat_layer(layer, c.raster, c.contribution);
      sink.splat_layer(layer + 1, c.raster, weighted);
    });
    // Importance over the density of raster positions is divided out: what is left is radiance.
    sink.add(raster, seen * scale_);
  }

 private:
  void trace_wave(const CellStreams& streams, SampleSink& sink, RayCounts& rays) {
    int left = 0;
    wave_->trace(rays);
    for (const BidirectionalWave::Splat& splat : wave_->splats())
      sink.splat(splat.raster, splat.weighted);
    for (int i = 0; i < wave_->size(); ++i) {
      if (wave_->fell_back(i))
        sample_cell(cells_[i], streams, sink, rays);
      else
        sink.add(wave_->raster(i), wave_->seen(i) * scale_);
      left += wave_->fell_back(i);
    }
    wave_worthwhile_ = 2 * left <= wave_->size();
    wave_->clear();
    cells_.clear();
  }

  const Scene* scene_;
  double scale_;
  BidirectionalSampler bidirectional_;
  bool techniques_;
  std::unique_ptr<BidirectionalWave> wave_;  ///< nullptr if it does not support the scene.
  std::vector<Vec2i> cells_;                 ///< Cells of the samples in the wave.
  bool wave_worthwhile_ = true;              ///< Unless most samples of the last one were left.
};

}  // namespace

Plugin integrator_bdpt() {
  return make_plugin<SampledIntegrator<BdptTaker>>(integrator_schema(
      "bdpt",
      "Bidirectional path tracing with every technique (s, t) and multiple importance sampling "
      "(Veach & Guibas 1994; Veach 1997, ch. 10). One spp is a camera and a light path per pixel.",
      {path_parameters(),
       bidirectional_parameters(),
       {{"techniques", ParamType::boolean, false,
         "Keep the image of each technique, raw and weighted; needs a max_depth of 16 or "
         "less."},
        {"manifolds", ParamType::boolean, false,
         "Find lights across chains of mirrors and glass, too (specular manifold sampling, "
         "Zeltner, Georgiev & Jakob 2020), where other techniques find them too rarely."}}}));
}

}  // namespace mlt
