// An invisible surface: every ray goes straight through, as a delta lobe of its own.
#include "base/registry.h"
#include "scene/bsdf.h"
#include "scene/bsdf/lobes.h"

namespace mlt {
namespace {

class Null final : public Bsdf {
 public:
  explicit Null(Params&) {}

  Scattering scattering(const SurfacePoint&, const Vec3&, const Vec3&, Lobe lobe) const override {
    return lobe == Lobe::null ? Scattering{Color(1), 1, 1} : Scattering{};
  }

  std::optional<BsdfSample> sample(const SurfacePoint&, const Vec3& from,
                                   const Vec3&) const override {
    return BsdfSample{-from, Lobe::null};
  }

  std::optional<Vec3> invert(const SurfacePoint&, const Vec3&, const Vec3&, Lobe lobe,
                             const Vec3& v) const override {
    if (lobe != Lobe::null) return std::nullopt;
    return v;
  }

  bool has_smooth() const override { return false; }
  bool has_delta() const override { return true; }
  bool has_transmission() const override { return true; }
  double roughness(const SurfacePoint&, const Vec3&, const Vec3&) const override { return 0; }
  Color albedo(const SurfacePoint&) const override { return Color(1); }
};

}  // namespace

Plugin bsdf_null() {
  return make_plugin<Null>("bsdf", "null", "An invisible surface: light goes straight through it.");
}

}  // namespace mlt
