// Scattering by particles that are much smaller than the wavelength, such as those of clear air
// (Rayleigh 1871): p(cos) = 3 (1 + cos^2) / (16 pi). Sampled as by Frisvad 2011, "Importance
// sampling the Rayleigh phase function".
#include "scene/phase/phase_function.h"

namespace mlt {
namespace {

class Rayleigh final : public PhaseFunction<Rayleigh> {
 public:
  static constexpr bool lanes = false;

  explicit Rayleigh(Params&) {}

  double density(double cosine) const { return 3 * inv_pi / 16 * (1 + cosine * cosine); }
  /// The root of cos^3 + 3 cos = 4 - 8 u, by Cardano's formula.
  double sample_cosine(double u) const {
    const double a = 2 - 4 * u;
    const double root = std::cbrt(std::abs(a) + std::sqrt(a * a + 1));
    return std::copysign(root - 1 / root, a);
  }
  double invert_cosine(double cosine) const { return 0.125 * (4 - cosine * (3 + cosine * cosine)); }
};

}  // namespace

Plugin phase_rayleigh() {
  return make_plugin<Rayleigh>("phase", "rayleigh", "Scatters light as clear air does.");
}

}  // namespace mlt
