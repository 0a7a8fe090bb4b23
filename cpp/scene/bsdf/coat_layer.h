// A layer above another material, with an index of refraction and an absorption: how directions
// change in it, and what it absorbs (Weidlich & Wilkie 2007, "Arbitrarily layered micro-facet
// surfaces").
#pragma once

#include "math/fresnel.h"
#include "scene/bsdf/ior_params.h"
#include "scene/bsdf/lobes.h"
#include "scene/texture/texture.h"

#include <optional>

namespace mlt {

class CoatLayer {
 public:
  /// `int_ior`, `ext_ior`, `thickness`, `sigma_a` and `specular_reflectance`.
  static std::vector<Parameter> parameters();
  explicit CoatLayer(Params& params)
      : eta_(relative_ior_param(params)),
        thickness_(params.real_in("thickness", 0, 1e9)),
        absorption_(unbounded_texture_param(params, "sigma_a")),
        reflectance_(texture_param(params, "specular_reflectance")) {
    const double kept = target_luminance(glm::exp(-2 * thickness_ * absorption_->mean()));
    specular_weight_ = 1 / (kept + 1);
  }

  double eta() const { return eta_; }
  Spectrum reflectance(const SurfacePoint& at) const { return reflectance_->eval(at); }

  /// A direction below the layer's surface, still pointing to the outer side.
  struct Inside {
    Vec3 w;
    double F;  ///< 1: nothing comes through.
  };
  Inside inside(const Vec3& w) const {
    const Fresnel F = fresnel_dielectric(std::abs(w.z), eta_);
    const double z = eta_ == 1 ? std::abs(w.z) : -F.cos_t;
    return {Vec3(w.x * F.eta_ti, w.y * F.eta_ti, std::copysign(z, w.z)),
            F.cos_t == 0 ? 1 : F.reflectance};
  }
  /// The direction outside of a direction inside the layer; nullopt on total reflection.
  std::optional<Vec3> outside(const Vec3& w) const {
    const double cos2 = 1 - sqr(eta_) * sin2_theta(w);
    if (!(cos2 > 0)) return std::nullopt;
    return Vec3(w.x * eta_, w.y * eta_, std::copysign(std::sqrt(cos2), w.z));
  }
  /// |dw' / dw| of the directions w outside and w' inside the layer.
  double compression(const Vec3& outer, const Vec3& inner) const {
    return std::abs(outer.z / inner.z) / sqr(eta_);
  }
  /// What the layer leaves of light in these directions inside of it.
  Spectrum transmittance(const SurfacePoint& at, const Vec3& l, const Vec3& c) const {
    return exp(absorption_->eval(at) * (-thickness_ * (1 / std::abs(l.z) + 1 / std::abs(c.z))));
  }
  /// The probability of sampling the layer's reflection where it reflects the fraction F.
  double specular_share(double F) const {
    return first_share(F * specular_weight_, (1 - F) * (1 - specular_weight_));
  }

 private:
  double eta_, thickness_, specular_weight_;
  TexturePtr absorption_, reflectance_;
};

inline std::vector<Parameter> CoatLayer::parameters() {
  return concat({ior_parameters("bk7"),
                 {{"thickness", ParamType::real, 1.0, "Of the layer, in the units of 1 / sigma_a."},
                  {"sigma_a", ParamType::emission, 0.0, "How much the layer absorbs per length."},
                  {"specular_reflectance", ParamType::texture, 1.0, "Factor on the reflection."}}});
}

}  // namespace mlt
