// A rough layer of varnish above another material, as in Mitsuba 0.6: the layer reflects as
// microfacets do (Walter et al. 2007, eq. 20), and lets pass what it does not reflect, T, as if its
// boundary were smooth:
//   f = F D G / (4 cos_l cos_c)
//       + T(wl) T(wc) exp(-a d (1 / |cos_l'| + 1 / |cos_c'|)) f'(wl', wc') / eta^2
// in the notation of coating.cpp, with T tabulated (rough_coating.h).
#include "base/registry.h"
#include "scene/bsdf/bsdf.h"
#include "scene/bsdf/coat_layer.h"
#include "scene/bsdf/rough_coating.h"
#include "scene/bsdf/rough_surface.h"
#include "scene/nested.h"

namespace mlt {
namespace {

class RoughlyCoated final : public Bsdf {
 public:
  explicit RoughlyCoated(Params& params)
      : layer_(params),
        microfacet_(isotropic_microfacet_param(params)),
        coating_(microfacet_.type(), microfacet_.alpha_u(), layer_.eta()),
        nested_(only_nested<Bsdf>(params, "bsdf")) {
    if (layer_.eta() == 1) params.fail("needs an int_ior that differs from ext_ior");
    if (nested_->has_passage())
      params.fail("cannot hold a bsdf through which light goes straight on");
  }

  Scattering scattering(const SurfacePoint& at, const Vec3& wl, const Vec3& wc,
                        Lobe lobe) const override {
    if (wl.z * wc.z == 0) return {};
    Scattering s = below(at, wl, wc, lobe);
    if (lobe != Lobe::smooth || !same_side(wl, wc)) return s;
    const MicrofacetReflection mirror(microfacet_, upwards(wl), upwards(wc));
    s.f += specular(at, wl, wc, mirror);
    s.pdf_from_light += specular_share(wl) * mirror.pdf_from_light;
    s.pdf_from_camera += specular_share(wc) * mirror.pdf_from_camera;
    return s;
  }

  std::optional<BsdfSample> sample(const SurfacePoint& at, const Vec3& from,
                                   const Vec3& u) const override {
    if (from.z == 0) return std::nullopt;
    const double p = specular_share(from);
    if (u.x < p) {
      const Vec3 to = mirrored(microfacet_, upwards(from), direction_part(u));
      if (!(to.z > 0)) return std::nullopt;
      return BsdfSample{from.z < 0 ? -to : to, Lobe::smooth};
    }
    const CoatLayer::Inside in = layer_.inside(from);
    if (!(in.F < 1)) return std::nullopt;
    auto sampled = nested_->sample(at, in.w, {(u.x - p) / (1 - p), u.y, u.z});
    if (!sampled) return std::nullopt;
    const auto out = layer_.outside(sampled->to);
    if (!out) return std::nullopt;
    sampled->to = *out;
    return sampled;
  }

  std::optional<Vec3> invert(const SurfacePoint& at, const Vec3& from, const Vec3& to, Lobe lobe,
                             const Vec3& v) const override {
    const double total = pdf(at, from, to, lobe);
    if (!(total > 0)) return std::nullopt;
    const double p = specular_share(from), nested = below(at, from, to, lobe).pdf_from_light;
    const LobeGuess guess = guess_lobe(std::max(0.0, total - nested), nested, v.x);
    if (guess.first)
      return u_of(
          u_of_first(p, guess.rest),
          Microfacet(microfacet_).invert(upwards(from), normalize(upwards(from) + upwards(to))));
    auto u = nested_->invert(at, layer_.inside(from).w, layer_.inside(to).w, lobe,
                             {guess.rest, v.y, v.z});
    if (u) u->x = u_of_second(p, u->x);
    return u;
  }

  bool has_delta() const override { return nested_->has_delta(); }
  bool has_transmission() const override { return nested_->has_transmission(); }
  /// By Snell's law on both sides of the nested interface, the layer cancels.
  double relative_eta(const SurfacePoint& at, const Vec3& w) const override {
    return nested_->relative_eta(at, w);
  }
  /// The roughness of the lobe that contributes more between the two directions.
  double roughness(const SurfacePoint& at, const Vec3& wl, const Vec3& wc) const override {
    const double base = target_luminance(below(at, wl, wc, Lobe::smooth).f);
    if (same_side(wl, wc)) {
      const MicrofacetReflection mirror(microfacet_, upwards(wl), upwards(wc));
      if (target_luminance(specular(at, wl, wc, mirror)) > base) return microfacet_.alpha_u();
    }
    return nested_->roughness(at, layer_.inside(wl).w, layer_.inside(wc).w);
  }
  double least_roughness() const override {
    return std::min(microfacet_.alpha_u(), nested_->least_roughness());
  }
  Spectrum albedo(const SurfacePoint& at) const override {
    const RoughFresnel coat = coating_.at(1.0);
    return coat.reflectance * layer_.reflectance(at) +
           sqr(coat.transmittance) * nested_->albedo(at);
  }

 private:
  /// The reflection by the layer.
  Spectrum specular(const SurfacePoint& at, const Vec3& wl, const Vec3& wc,
                    const MicrofacetReflection<double>& mirror) const {
    const double F = fresnel_dielectric(dot(upwards(wl), mirror.h), layer_.eta()).reflectance;
    return layer_.reflectance(at) * (F * mirror.DG / (4 * std::abs(wl.z * wc.z)));
  }
  /// The scattering by the material below, through the layer.
  Scattering below(const SurfacePoint& at, const Vec3& wl, const Vec3& wc, Lobe lobe) const {
    const CoatLayer::Inside l = layer_.inside(wl), c = layer_.inside(wc);
    if (!(l.F < 1 && c.F < 1)) return {};
    Scattering s = nested_->scattering(at, l.w, c.w, lobe);
    s.f *= coating_.at(std::abs(wl.z)).transmittance * coating_.at(std::abs(wc.z)).transmittance *
           layer_.transmittance(at, l.w, c.w);
    s.pdf_from_light *= 1 - specular_share(wl);
    s.pdf_from_camera *= 1 - specular_share(wc);
    if (lobe != Lobe::smooth) return s;
    s.f /= sqr(layer_.eta());
    s.pdf_from_light *= layer_.compression(wc, c.w);
    s.pdf_from_camera *= layer_.compression(wl, l.w);
    return s;
  }
  double specular_share(const Vec3& w) const {
    return layer_.specular_share(1 - coating_.at(std::abs(w.z)).transmittance);
  }

  CoatLayer layer_;
  Microfacet microfacet_;
  RoughCoating coating_;
  BsdfPtr nested_;
};

}  // namespace

Plugin bsdf_roughcoating() {
  Plugin plugin = make_plugin<RoughlyCoated>(
      "bsdf", "roughcoating", "A rough layer of varnish above the nested bsdf.",
      concat({CoatLayer::parameters(), isotropic_microfacet_parameters()}));
  plugin.schema.reciprocal = false;  // the nested one may refract
  return plugin;
}

}  // namespace mlt
