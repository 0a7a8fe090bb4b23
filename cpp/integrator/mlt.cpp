// mlt: Metropolis light transport in path space. E. Veach and L. Guibas, "Metropolis light
// transport", SIGGRAPH 1997; Veach 1997, ch. 11.
#include "base/registry.h"
#include "integrator/parameters.h"
#include "integrator/separate_direct.h"
#include "integrator/tours/mlt_algorithm.h"

namespace mlt {
namespace {

class MltIntegrator : public Integrator {
 public:
  explicit MltIntegrator(Params& params) : metropolis_(metropolis_settings(params)) {
    settings_.rules = path_rules(params);
    settings_.rules.through_boundaries = true;
    const std::string independent = params.text("independent");
    if (independent == "bdpt") metropolis_.techniques = SampleTechniques::all;
    if (independent == "path") metropolis_.techniques = SampleTechniques::path_tracing;
    settings_.samples_beside = metropolis_.independent_share != 0;
    settings_.near_specular = params.real_in("near_specular", 0, 1);
    settings_.two_stage = params.boolean("two_stage");
    settings_.manifolds = params.boolean("manifolds");
    settings_.delayed_rejection = params.boolean("delayed_rejection");
    if (params.has("patience"))
      params.fail(
          "patience",
          "is gone: a tour now waits before it is a spark, not when it is long; see 'spark'");
    settings_.spark = params.real_in("spark", 0, 1e6);
    direct_samples_ = static_cast<int>(params.integer_in("direct_samples", -1, 1 << 20));
    if (direct_samples_ >= 0) settings_.rules.min_depth = 3;
    metropolis_.light = light_layers(params);
    settings_.mixture = read_mixture(params, mutation_plugins());
    const bool chosen =
        std::any_of(mutation_plugins().begin(), mutation_plugins().end(),
                    [&](const MutationPlugin& plugin) { return params.has(plugin.weight_name()); });
    settings_.adaptive = params.has("adaptive") ? params.boolean("adaptive") : !chosen;
  }
  std::unique_ptr<Rendering> start(ScenePtr scene, uint64_t seed) const override {
    SeparateDirect direct;
    if (direct_samples_ >= 0)
      direct = separate_direct(scene, seed, direct_samples_, settings_.rules.hide_emitters,
                               settings_.rules.strict_normals, metropolis_.light);
    return std::make_unique<MetropolisRendering>(
        scene, seed, metropolis_, mlt_algorithm(scene, settings_), std::move(direct));
  }
  std::shared_ptr<const Integrator> with_mutations(
      const std::vector<ExtraMutation>& extra) const override {
    auto more = std::make_shared<MltIntegrator>(*this);
    more->settings_.extra.insert(more->settings_.extra.end(), extra.begin(), extra.end());
    return more;
  }

 private:
  MetropolisSettings metropolis_;
  MltSettings settings_;
  int direct_samples_ = -1;
};

}  // namespace

Plugin integrator_mlt() {
  return make_plugin<MltIntegrator>(integrator_schema(
      "mlt",
      "Metropolis light transport in path space with Veach's mutations (Veach & Guibas 1997). One "
      "spp is one mutation per pixel.",
      {path_parameters(),
       light_parameters(),
       tour_parameters(128),
       family_parameters(),
       mixture_parameters(mutation_plugins()),
       {{"near_specular", ParamType::real, 0.1,
         "Smooth vertices below this roughness count as specular in perturbations."},
        {"adaptive", ParamType::boolean, true,
         "Let pilot chains find the weights and step sizes of the mutations; by default "
         "only if no weight is given, and never for a step size that is given."},
        {"two_stage", ParamType::boolean, true,
         "Divide the target by a coarse image, so that dark regions get their share."},
        {"manifolds", ParamType::boolean, true,
         "Tours start from lights found across chains of mirrors and glass, too (specular manifold "
         "sampling, Zeltner, Georgiev & Jakob 2020), where other samples find them too rarely."},
        {"delayed_rejection", ParamType::boolean, false,
         "Let a smaller step follow where a perturbation's proposal was rejected."},
        choice_parameter(
            "independent", "auto",
            "What the independent samples are: those of bidirectional path tracing, or "
            "of path tracing, which are cheaper; by default, those with less noise in the end.",
            {"auto", "bdpt", "path"}),
        {"spark", ParamType::real, 1.0,
         "A tour, the mutations from one start of a chain, waits before it leaves more light in a "
         "pixel than this many times what pixels have received in the mean by then (up to three "
         "times as much where nearly all light is left to tours). 0: none "
         "waits; the image is then right in the mean from the start, but may have sparks."},
        {"patience", ParamType::real, no_default, "Replaced by `spark`; it is refused."},
        {"direct_samples", ParamType::integer, int64_t{-1},
         "Render light of at most one reflection apart with this many samples per pixel; "
         "0 leaves it out, -1 leaves it to the chains."}}}));
}

}  // namespace mlt
