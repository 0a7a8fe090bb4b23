// A thin pane of glass as one surface: all reflections between its two sides are summed. With the
// Fresnel reflectance F of one side, R = F + (1 - F)^2 F (1 + F^2 + F^4 + ...) = 2 F / (1 + F) is
// reflected, and 1 - R goes straight through (Stokes 1862, "On the intensity of the light reflected
// from or transmitted through a pile of plates").
#include "base/registry.h"
#include "math/fresnel.h"
#include "scene/bsdf/bsdf.h"
#include "scene/bsdf/dielectric_interface.h"

namespace mlt {
namespace {

class ThinDielectric final : public Bsdf {
 public:
  explicit ThinDielectric(Params& params) : interface_(params) {}

  Passage passage(const SurfacePoint& at, const Vec3& w) const override {
    const double R = reflected(at, w);
    return {(Spectrum(1) - reflected_spectrum(at, w)) * interface_.transmittance->eval(at),
            1 - interface_.reflection_probability(R)};
  }
  bool has_passage() const override { return true; }

  Scattering scattering(const SurfacePoint& at, const Vec3& wl, const Vec3&,
                        Lobe lobe) const override {
    if (lobe != Lobe::reflection) return {};
    return {reflected_spectrum(at, wl) * interface_.reflectance->eval(at), 1, 1};
  }
  std::optional<BsdfSample> sample(const SurfacePoint&, const Vec3& from,
                                   const Vec3&) const override {
    return BsdfSample{reflect(from), Lobe::reflection};
  }
  std::optional<Vec3> invert(const SurfacePoint&, const Vec3&, const Vec3&, Lobe lobe,
                             const Vec3& v) const override {
    if (lobe != Lobe::reflection) return std::nullopt;
    return v;
  }

  bool has_smooth() const override { return false; }
  bool has_delta() const override { return true; }
  bool has_transmission() const override { return true; }
  double roughness(const SurfacePoint&, const Vec3&, const Vec3&) const override { return 0; }
  Spectrum albedo(const SurfacePoint& at) const override {
    const double R = pane(1, interface_.eta());
    return interface_.albedo(at, R);
  }

 private:
  /// The reflectance R of the pane, which is the same from both sides.
  static double pane(double cosine, double eta) {
    const double F = fresnel_dielectric(cosine, eta).reflectance;
    return 2 * F / (1 + F);
  }
  double reflected(const SurfacePoint& at, const Vec3& w) const {
    return pane(std::abs(w.z), interface_.eta(at));
  }
  Spectrum reflected_spectrum(const SurfacePoint& at, const Vec3& w) const {
    return interface_.at_wavelengths(at, reflected(at, w),
                                     [&](double eta) { return pane(std::abs(w.z), eta); });
  }

  DielectricInterface interface_;
};

}  // namespace

Plugin bsdf_thindielectric() {
  return make_plugin<ThinDielectric>(
      "bsdf", "thindielectric",
      "A thin pane of glass: it reflects, and light goes straight through it.",
      concat({ior_parameters("bk7"), interface_factors()}));
}

}  // namespace mlt
