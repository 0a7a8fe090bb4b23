// A smooth layer of varnish above another material (Weidlich & Wilkie 2007, "Arbitrarily layered
// micro-facet surfaces", as in Mitsuba 0.6): light is mirrored by the layer with the fraction F;
// the rest is refracted, meets the material, and leaves through the layer again:
//   f(wl, wc) = T(wl) T(wc) exp(-a d (1 / |cos_l'| + 1 / |cos_c'|)) f'(wl', wc') / eta^2
// with T = 1 - F, absorption a, thickness d, and the refracted directions wl', wc'. Light that the
// layer reflects back to the material is lost.
#include "base/registry.h"
#include "math/fresnel.h"
#include "scene/bsdf/bsdf.h"
#include "scene/bsdf/ior_params.h"
#include "scene/bsdf/lobes.h"
#include "scene/nested.h"
#include "scene/texture/texture.h"

namespace mlt {
namespace {

class Coating final : public Bsdf {
 public:
  explicit Coating(Params& params)
      : eta_(relative_ior_param(params)),
        thickness_(params.real_in("thickness", 0, 1e9)),
        absorption_(unbounded_texture_param(params, "sigma_a")),
        reflectance_(texture_param(params, "specular_reflectance")) {
    nested_ = only_nested<Bsdf>(params, "bsdf");
    if (nested_->has_transmission()) params.fail("cannot hold a bsdf that transmits light");
    if (nested_->has_delta() && nested_->bends_normal())
      params.fail("cannot hold a bsdf that reflects light like a mirror of another normal");
    const double kept = target_luminance(glm::exp(-2 * thickness_ * absorption_->mean()));
    specular_weight_ = 1 / (kept + 1);
  }

  Scattering scattering(const SurfacePoint& at, const Vec3& wl, const Vec3& wc,
                        Lobe lobe) const override {
    if (!same_side(wl, wc)) return {};
    const Inside l = inside(wl), c = inside(wc);
    const double pl = specular_share(l.F), pc = specular_share(c.F);
    Scattering s{};
    if (l.F < 1 && c.F < 1) {
      s = nested_->scattering(at, l.w, c.w, lobe);
      s.f *= (1 - l.F) * (1 - c.F) * transmittance(at, l.w, c.w);
      s.pdf_from_light *= 1 - pl;
      s.pdf_from_camera *= 1 - pc;
      if (lobe == Lobe::smooth) {
        s.f /= sqr(eta_);
        s.pdf_from_light *= compression(wc, c.w);
        s.pdf_from_camera *= compression(wl, l.w);
      }
    }
    if (lobe != Lobe::reflection) return s;
    return {s.f + l.F * reflectance_->eval(at), s.pdf_from_light + pl, s.pdf_from_camera + pc};
  }

  std::optional<BsdfSample> sample(const SurfacePoint& at, const Vec3& from,
                                   const Vec3& u) const override {
    if (from.z == 0) return std::nullopt;
    const Inside in = inside(from);
    const double p = specular_share(in.F);
    if (u.x < p) return BsdfSample{reflect(from), Lobe::reflection};
    auto sampled = nested_->sample(at, in.w, {(u.x - p) / (1 - p), u.y, u.z});
    if (!sampled) return std::nullopt;
    if (sampled->lobe != Lobe::smooth) {
      sampled->to = reflect(from);
      return sampled;
    }
    const auto out = outside(sampled->to);
    if (!out) return std::nullopt;
    sampled->to = *out;
    return sampled;
  }

  std::optional<Vec3> invert(const SurfacePoint& at, const Vec3& from, const Vec3& to, Lobe lobe,
                             const Vec3& v) const override {
    const double total = pdf(at, from, to, lobe);
    if (!(total > 0)) return std::nullopt;
    const Inside in = inside(from);
    const double p = specular_share(in.F), first = lobe == Lobe::reflection ? p : 0;
    const LobeGuess guess = guess_lobe(first, std::max(0.0, total - first), v.x);
    if (guess.first) return Vec3(u_of_first(p, guess.rest), v.y, v.z);
    auto u = nested_->invert(at, in.w, inside(to).w, lobe, {guess.rest, v.y, v.z});
    if (u) u->x = u_of_second(p, u->x);
    return u;
  }

  bool has_smooth() const override { return nested_->has_smooth(); }
  bool has_delta() const override { return true; }
  double roughness(const SurfacePoint& at, const Vec3& wl, const Vec3& wc) const override {
    return nested_->roughness(at, inside(wl).w, inside(wc).w);
  }
  Spectrum albedo(const SurfacePoint& at) const override {
    const double F = inside({0, 0, 1}).F;
    return F * reflectance_->eval(at) + sqr(1 - F) * nested_->albedo(at);
  }

 private:
  /// A direction below the layer's surface, still pointing to the outer side.
  struct Inside {
    Vec3 w;
    double F;
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
  Spectrum transmittance(const SurfacePoint& at, const Vec3& l, const Vec3& c) const {
    return exp(absorption_->eval(at) * (-thickness_ * (1 / std::abs(l.z) + 1 / std::abs(c.z))));
  }
  double specular_share(double F) const {
    return first_share(F * specular_weight_, (1 - F) * (1 - specular_weight_));
  }

  double eta_, thickness_, specular_weight_;
  TexturePtr absorption_, reflectance_;
  BsdfPtr nested_;
};

}  // namespace

Plugin bsdf_coating() {
  return make_plugin<Coating>(
      "bsdf", "coating", "A smooth layer of varnish above the nested bsdf.",
      concat({ior_parameters("bk7"),
              {{"thickness", ParamType::real, 1.0, "Of the layer, in the units of 1 / sigma_a."},
               {"sigma_a", ParamType::emission, 0.0, "How much the layer absorbs per length."},
               {"specular_reflectance", ParamType::texture, 1.0, "Factor on the reflection."}}}));
}

}  // namespace mlt
