// An invisible surface: all light goes straight through it.
#include "base/registry.h"
#include "scene/bsdf/bsdf.h"

namespace mlt {
namespace {

class Null final : public Bsdf {
 public:
  explicit Null(Params&) {}

  Passage passage(const SurfacePoint&, const Vec3&) const override { return {}; }
  bool has_passage() const override { return true; }

  Scattering scattering(const SurfacePoint&, const Vec3&, const Vec3&, Lobe) const override {
    return {};
  }
  std::optional<BsdfSample> sample(const SurfacePoint&, const Vec3&, const Vec3&) const override {
    return std::nullopt;
  }
  std::optional<Vec3> invert(const SurfacePoint&, const Vec3&, const Vec3&, Lobe,
                             const Vec3&) const override {
    return std::nullopt;
  }

  bool has_smooth() const override { return false; }
  bool has_transmission() const override { return true; }
  double roughness(const SurfacePoint&, const Vec3&, const Vec3&) const override { return 0; }
  Spectrum albedo(const SurfacePoint&) const override { return Spectrum(1); }
};

}  // namespace

Plugin bsdf_null() {
  return make_plugin<Null>("bsdf", "null", "An invisible surface: light goes straight through it.");
}

}  // namespace mlt
