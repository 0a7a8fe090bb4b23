// OpenPBR Surface 1.1 (Academy Software Foundation): a diffuse, metallic or clear base below a thin
// film, a coat and fuzz. docs/openpbr.md says what differs from the specification.
#include "base/registry.h"
#include "scene/bsdf/glass_facet.h"
#include "scene/bsdf/ior_params.h"
#include "scene/bsdf/openpbr_reflection.h"

namespace mlt {

std::shared_ptr<Bsdf> openpbr_thin_wall(Params& params);

namespace {

/// A solid. Light enters it through transmission_weight and subsurface_weight, which is where it
/// meets a medium. What leaves a medium crosses the whole surface, so that subsurface_weight counts
/// once; the rest of it is as diffuse from below as from above.
class OpenPbr final : public OpenPbrReflection {
 public:
  explicit OpenPbr(Params& params)
      : OpenPbrReflection(params, Kind::solid), index_(index(params, eta_)) {
    if (glass_) inside_ = openpbr_inside(params, textures_);
  }

  Scattering scattering(const SurfacePoint& at, const Vec3& wl, const Vec3& wc,
                        Lobe lobe) const override {
    if (lobe != Lobe::smooth) return {};
    const Point<double> p = point(at);
    Scattering s;
    if (above(wl, wc)) {
      const Terms<double> t = terms(p, wl, wc);
      s = {value(colors(at), t), t.pdf_from_light, t.pdf_from_camera};
    } else {
      s = through(p, at, wl, wc);
    }
    s.f *= textures_.geometry_opacity.eval(at);
    return s;
  }

  std::optional<BsdfSample> sample(const SurfacePoint& at, const Vec3& from,
                                   const Vec3& u) const override {
    const Point<double> p = point(at);
    double rest = u.x;
    const size_t chosen = choice_of(p, at, from).choose(rest);
    if (from.z == 0 || chosen == lobe_count) return std::nullopt;
    const Vec2 v = direction_part(u);
    if (chosen == diffuse) {
      const Vec3 to = sample_cosine_hemisphere(v);
      return usable(from, from.z < 0 ? -to : to, true);
    }
    if (chosen == fuzz) return usable(from, FuzzLobe(from, p.fuzz_roughness).sample(v), true);
    const Vec3 h = (chosen == coat ? p.coat_facets : p.facets).sample(upwards(from), v);
    const double cos_h = dot(from, h);
    if (!(cos_h * from.z > 0)) return std::nullopt;
    if (chosen == coat || rest < reflected_by_facets(p, at, from, cos_h))
      return usable(from, reflect(from, h), true);
    const Fresnel F = fresnel_dielectric(cos_h, eta(at));
    if (F.cos_t == 0) return std::nullopt;
    return usable(from, refract(from, h, F.cos_t, F.eta_ti), false);
  }

  std::optional<Vec3> invert(const SurfacePoint& at, const Vec3& from, const Vec3& to, Lobe lobe,
                             const Vec3& v) const override {
    if (lobe != Lobe::smooth || !(above(from, to) || glass_)) return std::nullopt;
    const Point<double> p = point(at);
    const GlassFacet facet = glass_facet(from, to, eta(at));
    double rest = v.x;
    const size_t guess = LobeShares<lobe_count>::guess(densities_of(p, at, from, to, facet), rest);
    if (guess == lobe_count) return std::nullopt;
    const auto chosen = choice_of(p, at, from);
    if (guess != specular)
      return u_of(chosen.invert(guess, rest), invert_lobe(p, guess, upwards(from), upwards(to)));
    const double q = reflected_by_facets(p, at, from, dot(from, facet.h));
    return u_of(
        chosen.invert(specular, facet.reflects ? u_of_first(q, rest) : u_of_second(q, rest)),
        Microfacet(p.facets).invert(upwards(from), facet.h));
  }

  const SideIndex* index_inside() const override { return glass_ ? &index_.inside : nullptr; }
  BsdfPtr immersed(const SideIndex& outside) const override {
    if (!glass_) return nullptr;
    auto there = std::make_shared<OpenPbr>(*this);
    there->index_.outside = outside;
    there->set_eta(textures_.relative_ior(outside.in_rgb));
    return there;
  }
  double relative_eta(const SurfacePoint& at, const Vec3& w) const override {
    return glass_ ? eta_on_side(eta(at), w) : 1;
  }
  double roughness(const SurfacePoint& at, const Vec3& wl, const Vec3& wc) const override {
    const Point<double> p = point(at);
    if (above(wl, wc)) return roughness_of(colors(at), p, terms(p, wl, wc));
    if (!glass_ || !glass_facet(wl, wc, eta(at)).exists) return infinity;
    return p.facets.least_alpha();
  }

 private:
  static RelativeIndex index(Params& params, double eta) {
    const double scale = params.real_in("transmission_dispersion_scale", 0, 1),
                 number = params.real_in("transmission_dispersion_abbe_number", 1e-3, 1e9);
    const RefractiveIndex curve =
        scale > 0 ? RefractiveIndex::abbe(eta, number / scale) : RefractiveIndex::constant(eta);
    return {{curve, eta}, {RefractiveIndex::constant(1), 1}};
  }
  bool disperses(const SurfacePoint& at) const {
    return glass_ && at.wavelength >= 0 && index_.disperses();
  }
  double eta(const SurfacePoint& at) const {
    return disperses(at) ? index_.at_nm(wavelength_of(at.wavelength)) : eta_;
  }

  /// The share of the dielectric's surface that light from below leaves through.
  double leaves(const SurfacePoint& at) const {
    return textures_.subsurface_weight.eval(at) > 0 ? 1 : textures_.transmission_weight.eval(at);
  }
  LobeShares<lobe_count> choice_of(const Point<double>& p, const SurfacePoint& at,
                                   const Vec3& from) const {
    if (from.z > 0) return choice(p, shares(p, from));
    if (!glass_) return LobeShares<lobe_count>({0, 0, 0, 0});
    const double out = leaves(at), dielectric = 1 - p.metalness;
    return LobeShares<lobe_count>({dielectric * (1 - out) * base_weight_, dielectric * out, 0, 0});
  }
  /// The probability that a sampled facet of the base reflects.
  double reflected_by_facets(const Point<double>& p, const SurfacePoint& at, const Vec3& from,
                             double cos_h) const {
    if (from.z > 0) return reflected_share(p, reflectance(cos_h));
    const Fresnel F = fresnel_dielectric(cos_h, eta(at));
    return F.reflectance + (1 - F.reflectance) * reflected_back(p, F.cos_t);
  }
  /// What coat and fuzz reflect back of light that leaves the solid below them.
  double reflected_back(const Point<double>& p, double cosine) const {
    return 1 - shares(p, Vec3(0, 0, std::abs(cosine))).under_coat();
  }

  /// The densities of `to`, lobe by lobe.
  Densities densities_of(const Point<double>& p, const SurfacePoint& at, const Vec3& from,
                         const Vec3& to, const GlassFacet& facet) const {
    if (above(from, to))
      return densities(p, from, to, reflected_by_facets(p, at, from, dot(from, facet.h)));
    const auto chosen = choice_of(p, at, from);
    Densities d{};
    if (from.z < 0 && to.z < 0) d[diffuse] = chosen.share[diffuse] * inv_pi * -to.z;
    if (!facet.exists) return d;
    const double q = reflected_by_facets(p, at, from, dot(from, facet.h));
    d[specular] =
        chosen.share[specular] * (facet.reflects ? q : 1 - q) *
        facet_pdf(p.facets, from, to, facet, p.facets.D(facet.h), p.facets.g1(from, facet.h));
    return d;
  }
  static double sum(const Densities& d) { return d[diffuse] + d[specular] + d[coat] + d[fuzz]; }

  /// Where one direction is below the surface or both are.
  Scattering through(const Point<double>& p, const SurfacePoint& at, const Vec3& wl,
                     const Vec3& wc) const {
    if (!glass_ || wl.z * wc.z == 0) return {};
    const GlassFacet facet = glass_facet(wl, wc, eta(at));
    Spectrum f(0);
    if (same_side(wl, wc))
      f = Spectrum((1 - p.metalness) * (1 - leaves(at)) * inv_pi) * textures_.base(at);
    if (facet.exists) f += facet_value(p, at, wl, wc, facet);
    const bool alone = disperses(at) && !facet.reflects;
    return {alone ? first_lane(f) : f, sum(densities_of(p, at, wl, wc, facet)),
            sum(densities_of(p, at, wc, wl, facet)), alone};
  }
  Spectrum facet_value(const Point<double>& p, const SurfacePoint& at, const Vec3& wl,
                       const Vec3& wc, const GlassFacet& facet) const {
    const Colors c = colors(at);
    const Vec3 &up = wl.z > 0 ? wl : wc, &down = wl.z > 0 ? wc : wl;
    const double D = p.facets.D(facet.h), cosines = std::abs(wl.z * wc.z),
                 G = p.facets.g1(wl, facet.h) * p.facets.g1(wc, facet.h);
    const double scaled = scale(glass_->below, p, down);
    const double in_air = cosine_in_air(facet, up);
    const Spectrum F = facet.F == 1 ? Spectrum(1) : interface_reflectance(c, in_air, facet.F);
    if (facet.reflects) {
      const Spectrum back = reflected_back(p, in_air) * through_coat(c, 2 / cosine_in_coat(in_air));
      return (F + (Spectrum(1) - F) * back) * ((1 - p.metalness) * leaves(at) * scaled *
                                               scale(glass_->below, p, up) * D * G / (4 * cosines));
    }
    const double T = textures_.transmission_weight.eval(at);
    const double other = wl.z > 0 ? p.enters - T : leaves(at) - T;
    const Spectrum weight = textures_.tints_glass
                                ? T * textures_.transmission_color->eval(at) + Spectrum(other)
                                : Spectrum(T + other);
    const double passed = shares(p, up).under_coat() * scaled * scale(glass_->above, p, up);
    return weight * (Spectrum(1) - F) * through_coat(c, 1 / cosine_in_coat(up.z)) *
           ((1 - p.metalness) * passed * D * G * refraction_jacobian(facet, wl, wc) / cosines);
  }
  /// The cosine above the facet of light that it scatters.
  static double cosine_in_air(const GlassFacet& facet, const Vec3& up) {
    const double cosine = std::abs(dot(up, facet.h));
    return up.z > 0 ? cosine : std::abs(fresnel_dielectric(-cosine, facet.eta).cos_t);
  }
  static std::optional<BsdfSample> usable(const Vec3& from, const Vec3& to, bool reflects) {
    if (to.z == 0 || same_side(from, to) != reflects) return std::nullopt;
    return BsdfSample{to, Lobe::smooth};
  }

  RelativeIndex index_;
};

}  // namespace

Plugin bsdf_openpbr() {
  Plugin plugin{{"bsdf", "openpbr",
                 "A material for many purposes (OpenPBR Surface 1.1): diffuse, metallic, clear, "
                 "with a thin film, a coat and fuzz.",
                 openpbr_parameters()},
                [](Params& params) -> ObjectPtr {
                  if (params.boolean("geometry_thin_walled")) return openpbr_thin_wall(params);
                  return std::make_shared<OpenPbr>(params);
                }};
  plugin.schema.reciprocal = false;  // glass
  return plugin;
}

}  // namespace mlt
