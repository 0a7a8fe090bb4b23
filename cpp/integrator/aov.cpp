// aov and depth: quantities of the surface that a camera ray hits first, as an image. No light is
// needed. One spp is one camera ray per pixel.
#include "rendering/aov.h"

#include "integrator/parameters.h"
#include "math/wavelengths.h"
#include "path/walk.h"
#include "rendering/sampled_rendering.h"

namespace mlt {
namespace {

class AovTaker : public SampleTaker {
 public:
  AovTaker(const Scene& scene, AovKind kind) : scene_(&scene), kind_(kind) {}

  void sample(const Vec2& raster, PixelSampler& sampler, SampleSink& sink,
              RayCounts& rays) override {
    const Camera& camera = scene_->camera();
    const Ray ray = camera_ray(camera, raster, sampler).ray;
    rays.count_intersect();
    const Vec3 value = aov_value(kind_, *scene_, ray, scene_->has_passages() ? sampler.next() : 0);
    sink.add_signed(raster, camera.records_xyz() ? undeveloped(value) : value);
  }

 private:
  const Scene* scene_;
  AovKind kind_;
};

struct FirstSurface : SampledDefaults {
  static SampledSettings film(AovKind) { return {}; }
  static std::unique_ptr<SampleTaker> taker(const Scene& scene, AovKind kind) {
    return std::make_unique<AovTaker>(scene, kind);
  }
};

/// The first of a list of layers.
struct FirstLayer : FirstSurface {
  static AovKind settings(Params& params) {
    try {
      if (const auto aovs = parse_aovs(params.text("aovs")); !aovs.empty()) return aovs[0].kind;
    } catch (const UsageError& error) {
      params.fail("aovs", error.what());
    }
    params.fail("aovs", "names no layer");
  }
};

struct Depth : FirstSurface {
  static AovKind settings(Params&) { return AovKind::depth; }
};

}  // namespace

Plugin integrator_aov() {
  return make_plugin<SampledIntegrator<FirstLayer>>(integrator_schema(
      "aov",
      "What the camera sees first, without light: the image is the first of its layers. Around "
      "another integrator it adds its layers to that one's image.",
      {{{"aovs", ParamType::text, std::string("albedo"),
         "Layers, each with a name or without: albedo:albedo, nn:sh_normal, ..."}}}));
}

Plugin integrator_depth() {
  return make_plugin<SampledIntegrator<Depth>>(integrator_schema(
      "depth", "The distance from the camera to the surface that it sees first, or 0.", {}));
}

}  // namespace mlt
