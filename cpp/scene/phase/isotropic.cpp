// Light that is scattered in all directions alike.
#include "scene/phase/isotropic.h"

#include "scene/nested.h"
#include "scene/phase/phase_function.h"

namespace mlt {
namespace {

class Isotropic final : public PhaseFunction<Isotropic> {
 public:
  static constexpr bool lanes = true;

  Isotropic() { supports_lanes_ = true; }
  explicit Isotropic(Params&) : Isotropic() {}

  template <class F>
  F density(const F&) const {
    return number<F>(uniform_sphere_pdf());
  }
  template <class F>
  F sample_cosine(const F& u) const {
    return 1 - 2 * u;
  }
  double invert_cosine(double cosine) const { return 0.5 * (1 - cosine); }
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
