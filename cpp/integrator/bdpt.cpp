// bdpt: bidirectional path tracing with all techniques (s, t) and multiple importance sampling.
// E. Lafortune and Y. Willems, "Bi-directional path tracing", Compugraphics 1993; E. Veach and L.
// Guibas, "Bidirectional estimators for light transport", EGWR 1994; Veach 1997, ch. 10.
#include "base/bytes.h"
#include "base/registry.h"
#include "image/splat_film.h"
#include "integrator/bdpt_params.h"
#include "integrator/path_params.h"
#include "integrator/sampled_rendering.h"

namespace mlt {
namespace {

struct BdptSettings {
  BidirectionalSettings paths;
  bool techniques = false;
};

/// The image of each technique, raw and weighted: the lecture's table of strategies.
class TechniqueFilms {
 public:
  TechniqueFilms(const Scene& scene, int max_depth)
      : names_(technique_names(max_depth)),
        film_(scene.camera().raster().size.x, scene.camera().raster().size.y, scene.film().filter,
              static_cast<int>(2 * names_.size())) {}

  void add(const Connection& c) {
    if (!is_finite(c.contribution)) return;
    const int index = technique_index(c.s, c.t);
    film_.add(2 * index, c.raster, c.contribution);
    film_.add(2 * index + 1, c.raster, c.contribution * c.weight);
  }

  /// Layers "raw.s1.t2" and "weighted.s1.t2", ...
  std::vector<NamedImage> images(double scale) const {
    std::vector<NamedImage> layers;
    std::vector<double> scales(2 * names_.size(), 0.0);
    for (size_t i = 0; i < scales.size(); ++i) {
      scales[i] = scale;
      layers.push_back({(i % 2 ? "weighted." : "raw.") + names_[i / 2], film_.image(scales)});
      scales[i] = 0;
    }
    return layers;
  }

  uint64_t saturated() const { return film_.saturated(); }
  std::string save() const { return film_.save(); }
  void load(const std::string& bytes) { film_.load(bytes); }
  void add(const std::string& bytes) { film_.add_groups(0, film_.group_count(), bytes); }

 private:
  std::vector<std::string> names_;
  SplatFilm film_;
};

class BdptRendering : public SampledRendering {
 public:
  BdptRendering(ScenePtr scene, uint64_t seed, const BdptSettings& settings)
      : SampledRendering(std::move(scene), seed, true), settings_(settings) {
    if (settings.techniques)
      techniques_ = std::make_unique<TechniqueFilms>(this->scene(), settings.paths.rules.max_depth);
  }

  std::vector<NamedImage> layers() const override {
    return techniques_ ? techniques_->images(splat_scale()) : std::vector<NamedImage>();
  }

  void add_stats(Stats& stats) const override {
    SampledRendering::add_stats(stats);
    if (techniques_ && techniques_->saturated() > 0)
      stats.warnings.push_back(
          "an image of a technique exceeded its fixed-point range; its brightest pixels are wrong");
  }

  std::string save() const override {
    ByteWriter bytes;
    bytes.write(SampledRendering::save());
    bytes.write(techniques_ ? techniques_->save() : std::string());
    return bytes.take();
  }
  void load(const std::string& saved) override {
    ByteReader bytes(saved);
    std::string image, techniques;
    bytes.read(image);
    bytes.read(techniques);
    bytes.finish();
    if (techniques_) techniques_->load(techniques);
    SampledRendering::load(image);
  }

  std::string give_back(const Work& work) const override {
    ByteWriter bytes;
    bytes.write(SampledRendering::give_back(work));
    bytes.write(techniques_ ? techniques_->save() : std::string());
    return bytes.take();
  }
  void take_back(const Work& work, const std::string& given_back) override {
    ByteReader bytes(given_back);
    std::string image, techniques;
    bytes.read(image);
    bytes.read(techniques);
    bytes.finish();
    SampledRendering::take_back(work, image);
    if (techniques_) techniques_->add(techniques);
  }

 private:
  std::unique_ptr<Worker> make_worker() override {
    return std::make_unique<BdptWorker>(scene(), settings_.paths, techniques_.get());
  }

  class BdptWorker : public Worker {
   public:
    BdptWorker(const Scene& scene, const BidirectionalSettings& settings,
               TechniqueFilms* techniques)
        : scene_(&scene),
          scale_(radiance_scale(scene)),
          bidirectional_(scene, settings),
          techniques_(techniques) {}

    void sample(const Vec2& raster, PixelSampler& sampler, Sink& sink, RayCounts& rays) override {
      bidirectional_.sample(raster, sampler, rays);
      Color seen(0);
      bidirectional_.connect_all(rays, [&](const Connection& c) {
        if (c.t >= 2)
          seen += c.contribution * c.weight;
        else
          sink.splat(c.raster, c.contribution * c.weight);
        if (std::vector<FoundPath>* paths = sink.paths())
          paths->push_back(found_path(*scene_, bidirectional_, c));
        else if (techniques_)
          techniques_->add(c);
      });
      // Importance over the density of raster positions is divided out: what is left is radiance.
      sink.add(raster, seen * scale_);
    }

   private:
    const Scene* scene_;
    double scale_;
    BidirectionalSampler bidirectional_;
    TechniqueFilms* techniques_;
  };

  BdptSettings settings_;
  std::unique_ptr<TechniqueFilms> techniques_;
};

class BdptIntegrator : public Integrator {
 public:
  explicit BdptIntegrator(Params& params) {
    settings_.paths = bidirectional_settings(params);
    settings_.techniques = params.boolean("techniques");
    if (settings_.techniques &&
        (settings_.paths.rules.max_depth < 0 || settings_.paths.rules.max_depth > 16))
      params.fail("techniques",
                  "needs a max_depth from 1 to 16: it keeps an image for each technique");
  }
  std::unique_ptr<Rendering> start(ScenePtr scene, uint64_t seed) const override {
    return std::make_unique<BdptRendering>(std::move(scene), seed, settings_);
  }

 private:
  BdptSettings settings_;
};

}  // namespace

Plugin integrator_bdpt() {
  Schema schema;
  schema.family = "integrator";
  schema.name = "bdpt";
  schema.doc =
      "Bidirectional path tracing with every technique (s, t) and multiple importance sampling "
      "(Veach & Guibas 1994; Veach 1997, ch. 10). One spp is a camera and a light path per pixel.";
  schema.parameters = path_parameters();
  for (const Parameter& own : bidirectional_parameters()) schema.parameters.push_back(own);
  schema.parameters.push_back(
      {"techniques", ParamType::boolean, false,
       "Keep the image of each technique, raw and weighted; needs a max_depth of 16 or less."});
  return {schema,
          [](Params& params) -> ObjectPtr { return std::make_shared<BdptIntegrator>(params); }};
}

}  // namespace mlt
