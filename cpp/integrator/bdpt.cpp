// bdpt: bidirectional path tracing with all techniques (s, t) and multiple importance sampling.
// E. Lafortune and Y. Willems, "Bi-directional path tracing", Compugraphics 1993; E. Veach and L.
// Guibas, "Bidirectional estimators for light transport", EGWR 1994; Veach 1997, ch. 10.
#include "integrator/bdpt_params.h"
#include "integrator/path_params.h"
#include "integrator/sampled_rendering.h"

namespace mlt {
namespace {

struct BdptSettings {
  BidirectionalSettings paths;
  bool techniques = false;
};

class BdptTaker : public SampleTaker {
 public:
  static BdptSettings settings(Params& params) {
    const BdptSettings settings{bidirectional_settings(params), params.boolean("techniques")};
    if (settings.techniques &&
        (settings.paths.rules.max_depth < 0 || settings.paths.rules.max_depth > 16))
      params.fail("techniques",
                  "needs a max_depth from 1 to 16: it keeps an image for each technique");
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
        techniques_(settings.techniques) {}

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
  const Scene* scene_;
  double scale_;
  BidirectionalSampler bidirectional_;
  bool techniques_;
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
         "less."}}}));
}

}  // namespace mlt
