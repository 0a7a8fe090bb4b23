// erpt: energy redistribution path tracing. D. Cline, J. Talbot, P. Egbert, "Energy redistribution
// path tracing", SIGGRAPH 2005: tours that all die at the same rate (markov/tour.h), and no samples
// beside them.
#include "base/registry.h"
#include "integrator/parameters.h"
#include "integrator/tours/mlt_algorithm.h"

namespace mlt {
namespace {

std::vector<MutationPlugin> perturbations() {
  std::vector<MutationPlugin> plugins;
  for (const MutationPlugin& plugin : mutation_plugins())
    if (plugin.has_step_size()) plugins.push_back(plugin);
  return plugins;
}

class ErptIntegrator : public Integrator {
 public:
  explicit ErptIntegrator(Params& params) {
    metropolis_.luminance_samples = params.integer_in("luminance_samples", 16, int64_t{1} << 40);
    metropolis_.chains = static_cast<int>(params.integer_in("chains", 16, 1 << 24));
    metropolis_.independent_share = 0;
    settings_.rules = path_rules(params);
    settings_.near_specular = params.real_in("near_specular", 0, 1);
    metropolis_.light = light_layers(params);
    settings_.mixture = read_mixture(params, perturbations());
    settings_.adaptive = settings_.two_stage = settings_.samples_beside = false;
    settings_.tour_length = params.real_in("tour_length", 1, 1 << 24);
    metropolis_.steps_per_start = *settings_.tour_length * params.real_in("tours", 1e-6, 1e6);
  }
  std::unique_ptr<Rendering> start(ScenePtr scene, uint64_t seed) const override {
    return std::make_unique<MetropolisRendering>(scene, seed, metropolis_,
                                                 mlt_algorithm(scene, settings_));
  }

 private:
  MetropolisSettings metropolis_;
  MltSettings settings_;
};

}  // namespace

Plugin integrator_erpt() {
  return make_plugin<ErptIntegrator>(integrator_schema(
      "erpt",
      "Energy redistribution path tracing (Cline et al. 2005): short chains from the paths of "
      "bidirectional path tracing, moved by the perturbations of mlt. One spp is one mutation per "
      "pixel.",
      {path_parameters(),
       light_parameters(),
       tour_parameters(128),
       mixture_parameters(perturbations()),
       {{"near_specular", ParamType::real, 0.1,
         "Smooth vertices below this roughness count as specular in perturbations."},
        {"tours", ParamType::real, 0.1,
         "Tours per sample of bidirectional path tracing, in the mean. The fewer, the more samples "
         "they start from."},
        {"tour_length", ParamType::real, 100.0, "Mutations of each tour, in the mean."}}}));
}

}  // namespace mlt
