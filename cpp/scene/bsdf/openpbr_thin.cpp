// OpenPBR Surface 1.1, "Thin-walled case": a sheet that is seen alike from both sides. What goes
// through is light that the pane lets pass, spread as Burley 2015, fig. 15, spreads it, and the
// part of the subsurface scattering that leaves on the other side.
#include "scene/bsdf/openpbr_reflection.h"

namespace mlt {
namespace {

class OpenPbrThinWall final : public OpenPbrReflection {
 public:
  explicit OpenPbrThinWall(Params& params) : OpenPbrReflection(params, Kind::thin) {}

  Scattering scattering(const SurfacePoint& at, const Vec3& wl, const Vec3& wc,
                        Lobe lobe) const override {
    if (lobe != Lobe::smooth || wl.z * wc.z == 0) return {};
    const Point<double> p = point(at);
    const Vec3 l = upwards(wl), c = turned(wl, wc);
    Scattering s;
    if (same_side(wl, wc)) {
      s = {value(colors(at), terms(p, l, c)), sum(reflected(p, at, l, c)),
           sum(reflected(p, at, c, l))};
    } else {
      s = {transmitted(p, at, l, c), sum(passed(p, at, l, c)), sum(passed(p, at, c, l))};
    }
    s.f *= textures_.geometry_opacity.eval(at);
    return s;
  }

  std::optional<BsdfSample> sample(const SurfacePoint& at, const Vec3& from,
                                   const Vec3& u) const override {
    const Point<double> p = point(at);
    const Vec3 up = upwards(from);
    double rest = u.x;
    const size_t chosen = choice(p, shares(p, up)).choose(rest);
    if (from.z == 0 || chosen == lobe_count) return std::nullopt;
    const Vec2 v = direction_part(u);
    bool reflects = true;
    Vec3 to;
    if (chosen == diffuse) {
      reflects = rest >= through_share(at);
      to = sample_cosine_hemisphere(v);
    } else if (chosen == fuzz) {
      to = FuzzLobe<double>(up, p.fuzz_roughness).sample(v);
    } else if (chosen == coat) {
      to = mirrored(p.coat_facets, up, v);
    } else {
      reflects = rest < facet_share(p, up);
      to = mirrored(reflects ? p.facets : through_facets(p), up, v);
    }
    if (!(to.z > 0)) return std::nullopt;
    if (!reflects) to.z = -to.z;
    return BsdfSample{from.z < 0 ? -to : to, Lobe::smooth};
  }

  std::optional<Vec3> invert(const SurfacePoint& at, const Vec3& from, const Vec3& to, Lobe lobe,
                             const Vec3& v) const override {
    if (lobe != Lobe::smooth || from.z * to.z == 0) return std::nullopt;
    const Point<double> p = point(at);
    const bool reflects = same_side(from, to);
    const Vec3 up = upwards(from), out = turned(from, to);
    double rest = v.x;
    const size_t guess = LobeShares<lobe_count>::guess(
        reflects ? reflected(p, at, up, out) : passed(p, at, up, out), rest);
    if (guess == lobe_count) return std::nullopt;
    const auto chosen = choice(p, shares(p, up));
    if (guess == diffuse) {
      const double t = through_share(at);
      rest = reflects ? u_of_second(t, rest) : u_of_first(t, rest);
    } else if (guess == specular) {
      const double q = facet_share(p, up);
      rest = reflects ? u_of_first(q, rest) : u_of_second(q, rest);
      if (!reflects)
        return u_of(chosen.invert(guess, rest),
                    Microfacet(through_facets(p)).invert(up, normalize(up + out)));
    }
    return u_of(chosen.invert(guess, rest), invert_lobe(p, guess, up, out));
  }

  double roughness(const SurfacePoint& at, const Vec3& wl, const Vec3& wc) const override {
    const Point<double> p = point(at);
    const Vec3 l = upwards(wl), c = turned(wl, wc);
    if (same_side(wl, wc)) return roughness_of(colors(at), p, terms(p, l, c));
    const Densities d = passed(p, at, l, c);
    return d[specular] > d[diffuse] ? through_facets(p).least_alpha() : infinity;
  }

 private:
  /// `to` where `from` is turned to be above, and mirrored if it is below then.
  static Vec3 turned(const Vec3& from, const Vec3& to) {
    return {from.z < 0 ? -to.x : to.x, from.z < 0 ? -to.y : to.y, std::abs(to.z)};
  }
  /// The microfacets for light that is refracted twice.
  Ggx<double> through_facets(const Point<double>& p) const {
    const double spread = std::clamp(0.65 * eta_ - 0.35, 0.1, 1.0);
    return {std::max(0.001, sqr(spread) * p.facets.alpha_u),
            std::max(0.001, sqr(spread) * p.facets.alpha_v)};
  }
  /// The probability that a facet reflects, and that the diffuse base transmits.
  double facet_share(const Point<double>& p, const Vec3& from) const {
    return reflected_share(p, reflectance(from.z));
  }
  double through_share(const SurfacePoint& at) const {
    return 0.5 * textures_.subsurface_weight.eval(at) * (1 + textures_.subsurface_anisotropy);
  }

  static double sum(const Densities& d) { return d[diffuse] + d[specular] + d[coat] + d[fuzz]; }
  // The densities of `to`, lobe by lobe; both directions are turned to be above.
  Densities reflected(const Point<double>& p, const SurfacePoint& at, const Vec3& from,
                      const Vec3& to) const {
    Densities d = densities(p, from, to, facet_share(p, from));
    d[diffuse] *= 1 - through_share(at);
    return d;
  }
  Densities passed(const Point<double>& p, const SurfacePoint& at, const Vec3& from,
                   const Vec3& to) const {
    const auto chosen = choice(p, shares(p, from));
    Densities d{};
    d[diffuse] = chosen.share[diffuse] * through_share(at) * inv_pi * to.z;
    d[specular] = chosen.share[specular] * (1 - facet_share(p, from)) *
                  MicrofacetReflection<double>(through_facets(p), from, to).pdf_from_light;
    return d;
  }

  Spectrum transmitted(const Point<double>& p, const SurfacePoint& at, const Vec3& l,
                       const Vec3& c) const {
    if (!transmits_) return Spectrum(0);
    const Colors colors = this->colors(at);
    const auto from_l = shares(p, l), from_c = shares(p, c);
    const double dielectric = 1 - p.metalness;
    const double diffused =
        dielectric * (1 - p.enters) * from_l.under_gloss() * from_c.under_gloss() * p.diffuse_scale;
    Spectrum f = diffused * inv_pi * colors.rho_through;
    if (p.enters > 0) {
      const Ggx<double> facets = through_facets(p);
      const MicrofacetReflection<double> mirror(facets, l, c);
      // What the rough interface reflects, in place of a single facet.
      const EnergyTable& scales = BalancedScales::of_mirrors().above;
      const double E =
          std::max(from_l.gloss, from_c.gloss) * scale(scales, p, l) * scale(scales, p, c);
      const double cosine = dot(l, mirror.h);
      const Spectrum F = interface_reflectance(colors, cosine, std::min(1.0, E));
      const double kept =
          scales.at(l.z, roughness_along(facets, l)) * scales.at(c.z, roughness_along(facets, c));
      f += pane(colors, F, cosine).transmitted *
           (dielectric * p.enters * kept * std::min(from_l.under_coat(), from_c.under_coat()) *
            mirror.DG / (4 * l.z * c.z));
    }
    return f * through_coat(colors, 0.5 / cosine_in_coat(l.z) + 0.5 / cosine_in_coat(c.z));
  }
};

}  // namespace

std::shared_ptr<Bsdf> openpbr_thin_wall(Params& params) {
  return std::make_shared<OpenPbrThinWall>(params);
}

}  // namespace mlt
