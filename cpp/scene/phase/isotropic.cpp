// Light that is scattered in all directions alike.
#include "scene/phase/isotropic.h"

#include "scene/nested.h"
#include "scene/phase/phase_function.h"

namespace mlt {
namespace {

class Isotropic final : public PhaseFunction {
 public:
  Isotropic() = default;
  explicit Isotropic(Params&) {}

 protected:
  double density(double) const override { return uniform_sphere_pdf(); }
  double sample_cosine(double u) const override { return 1 - 2 * u; }
  double invert_cosine(double cosine) const override { return 0.5 * (1 - cosine); }
};

}  // namespace

BsdfPtr phase_param(Params& params) {
  const BsdfPtr nested = optional_nested<Bsdf>(params, "phase");
  return nested ? nested : std::make_shared<Isotropic>();
}

Plugin phase_isotropic() {
  return make_plugin<Isotropic>("phase", "isotropic", "Scatters light in all directions alike.");
}

}  // namespace mlt
