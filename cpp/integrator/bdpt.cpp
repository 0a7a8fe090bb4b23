// bdpt: bidirectional path tracing with all techniques (s, t) and multiple importance sampling.
// E. Lafortune and Y. Willems, "Bi-directional path tracing", Compugraphics 1993; E. Veach and L.
// Guibas, "Bidirectional estimators for light transport", EGWR 1994; Veach 1997, ch. 10.
#include "integrator/parameters.h"
#include "path/technique_names.h"
#include "rendering/estimator_taker.h"
#include "wave/bidirectional_wave.h"

namespace mlt {
namespace {

struct BdptSettings {
  BidirectionalSettings paths;
  bool techniques = false, manifolds = false;
};

/// Bidirectional path tracing with an image for each technique.
class TechniqueTaker : public SampleTaker {
 public:
  TechniqueTaker(const Scene& scene, const BidirectionalSettings& settings)
      : estimator_(scene, settings) {}

  void sample(const Vec2& raster, PixelSampler& sampler, SampleSink& sink,
              RayCounts& rays) override {
    Color seen(0);
    estimator_.paths = sink.paths();
    estimator_.connect_all(raster, sampler, rays, [&](const Connection& c) {
      const Color weighted = c.contribution * c.weight;
      if (c.t >= 2)
        seen += weighted;
      else
        sink.splat(c.raster, weighted);
      const int layer = 2 * technique_index(c.s, c.t);
      sink.splat_layer(layer, c.raster, c.contribution);
      sink.splat_layer(layer + 1, c.raster, weighted);
    });
    sink.add(raster, seen * estimator_.own_scale());
  }

 private:
  BidirectionalEstimator estimator_;
};

struct BdptIntegrator : SampledDefaults {
  static LightLayerSettings light_layers(Params& params) {
    const LightLayerSettings layers = mlt::light_layers(params);
    if (layers.any() && params.boolean("techniques"))
      params.fail("techniques", "excludes light_groups and light_layers; choose one of them");
    return layers;
  }
  static BdptSettings settings(Params& params) {
    BdptSettings settings{bidirectional_settings(params), params.boolean("techniques"),
                          params.boolean("manifolds")};
    settings.paths.rules.through_boundaries = params.boolean("through_boundaries");
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
  static std::unique_ptr<SampleTaker> taker(const Scene& scene, const BdptSettings& settings) {
    if (settings.techniques) return std::make_unique<TechniqueTaker>(scene, settings.paths);
    return take_alone(BidirectionalEstimator(scene, settings.paths),
                      BidirectionalWave::where_supported(scene, settings.paths));
  }
};

}  // namespace

Plugin integrator_bdpt() {
  return make_plugin<SampledIntegrator<BdptIntegrator>>(integrator_schema(
      "bdpt",
      "Bidirectional path tracing with every technique (s, t) and multiple importance sampling "
      "(Veach & Guibas 1994; Veach 1997, ch. 10). One spp is a camera and a light path per pixel.",
      {path_parameters(),
       light_parameters(),
       bidirectional_parameters(),
       {{"techniques", ParamType::boolean, false,
         "Keep the image of each technique, raw and weighted; needs a max_depth of 16 or "
         "less."},
        {"manifolds", ParamType::boolean, false,
         "Find lights across chains of mirrors and glass, too (specular manifold sampling, "
         "Zeltner, Georgiev & Jakob 2020), where other techniques find them too rarely."},
        through_boundaries_parameter()}}));
}

}  // namespace mlt
