// Scenes choose a sampler; here the integrators choose their own random numbers, and only the
// number of samples counts.
#include "base/registry.h"
#include "scene/film/film_settings.h"

#include <limits>

namespace mlt {
namespace {

ObjectPtr create_sampler(Params& params) {
  auto sampler = std::make_shared<SamplerSettings>();
  if (params.has("sample_count"))
    sampler->sample_count =
        params.integer_in("sample_count", 1, std::numeric_limits<int32_t>::max());
  return sampler;
}

Plugin sampler(const char* name) {
  return {
      Schema{"sampler",
             name,
             "Accepted for its sample_count; integrators draw their own samples.",
             std::vector<Parameter>{{"sample_count", ParamType::integer, no_default,
                                     "Samples per pixel, if the render is given no other budget."}},
             {"seed", "jitter", "scramble", "dimension", "depth", "strength"}},
      create_sampler};
}

}  // namespace

Plugin sampler_independent() { return sampler("independent"); }
Plugin sampler_stratified() { return sampler("stratified"); }
Plugin sampler_ldsampler() { return sampler("ldsampler"); }
Plugin sampler_multijitter() { return sampler("multijitter"); }
Plugin sampler_orthogonal() { return sampler("orthogonal"); }
Plugin sampler_halton() { return sampler("halton"); }
Plugin sampler_sobol() { return sampler("sobol"); }
Plugin sampler_hammersley() { return sampler("hammersley"); }

}  // namespace mlt
