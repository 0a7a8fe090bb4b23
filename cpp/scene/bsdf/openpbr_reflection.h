// The reflection of OpenPBR above its surface, of one point or of eight: a model as in
// eight_points.h. Solids and thin walls add what goes through.
#pragma once

#include "scene/bsdf/eight_points.h"
#include "scene/bsdf/lobes.h"
#include "scene/bsdf/microfacet_energy.h"
#include "scene/bsdf/openpbr_diffuse.h"
#include "scene/bsdf/openpbr_layers.h"
#include "scene/bsdf/openpbr_textures.h"
#include "scene/bsdf/thin_film.h"

namespace mlt {

class OpenPbrReflection : public Bsdf {
 public:
  enum OpenPbrLobe : size_t { diffuse, specular, coat, fuzz, lobe_count };

  Passage passage(const SurfacePoint& at, const Vec3&) const override {
    const double o = textures_.geometry_opacity.eval(at);
    return {Spectrum(1 - o), 1 - o};
  }
  bool has_passage() const override {
    return !(textures_.geometry_opacity.is_constant() && textures_.geometry_opacity.mean() == 1);
  }
  Spectrum albedo(const SurfacePoint& at) const override { return textures_.base(at); }
  void scatter(ScatteringLanes& x) const override;
  bool has_transmission() const override { return transmits_ || has_passage(); }

  // The model of eight_points.h:

  template <class F>
  using Point = OpenPbrPoint<F>;
  template <class F>
  Point<F> point(const SurfacePoint* const* at) const;
  template <class F>
  F narrowest(const Point<F>& p) const {
    const F alpha = p.facets.least_alpha();
    return coated_ ? min(alpha, p.coat_facets.least_alpha()) : alpha;
  }

  template <class F>
  using Terms = OpenPbrTerms<F>;
  template <class F>
  Terms<F> terms(const Point<F>& p, const Vec3Of<F>& wl, const Vec3Of<F>& wc) const;

  template <class F>
  Vec3Of<F> direction(const Point<F>& p, const Vec3Of<F>& from, const Vec3Of<F>& u) const;

  struct Colors {
    Spectrum rho, rho_again;  ///< The diffuse base, where it reflects.
    Spectrum rho_through;     ///< And where it transmits.
    MetalColors metal;
    Spectrum specular, coat, fuzz;
    Spectrum darkening;  ///< What light that the coat reflects back leaves of the base.
    Spectrum within;     ///< What the inside of a thin pane leaves of light along the normal.
    double enters = 0, coat_weight = 0, film_weight = 0, gloss = 1, roughness = 0;
    double wavelength = rgb_lanes;
  };
  Colors colors(const SurfacePoint& at) const;
  Spectrum value(const Colors& colors, const Terms<double>& terms) const;

 protected:
  using Densities = std::array<double, lobe_count>;

  /// A solid, in which what scatters below the surface is a medium that light enters, or a thin
  /// wall.
  enum class Kind : uint8_t { solid, thin };
  OpenPbrReflection(Params& params, Kind kind);
  /// Sets n_below / n_above of the base.
  void set_eta(double eta);

  Point<double> point(const SurfacePoint& at) const {
    const SurfacePoint* one = &at;
    return point<double>(&one);
  }
  /// Fresnel's reflectance for light from above.
  template <class F>
  F reflectance(F cosine) const {
    return eta_ == 1 ? F(0) : dielectric_reflectance(cosine, eta_);
  }
  template <class F>
  OpenPbrShares<F> shares(const Point<F>& p, const Vec3Of<F>& w) const;
  template <class F>
  LobeShares<lobe_count, F> choice(const Point<F>& p, const OpenPbrShares<F>& reflected) const;
  /// The probability that a facet of the base with this Fresnel reflectance reflects.
  template <class F>
  F reflected_share(const Point<F>& p, F fresnel) const {
    const F reflects =
        p.metalness * number<F>(metal_weight_) * p.metal + (1 - p.metalness) * fresnel * p.gloss;
    const F refracts = (1 - p.metalness) * p.enters * (1 - fresnel * p.gloss);
    return select(refracts > 0, reflects / max(reflects + refracts, number<F>(1e-30)), F(1));
  }
  /// The densities with which each lobe reflects `from` to `to`; `reflects`: the probability that
  /// the base's facets do.
  Densities densities(const Point<double>& p, const Vec3& from, const Vec3& to,
                      double reflects) const;
  /// The numbers for which the lobe reflects `from` to `to`.
  Vec2 invert_lobe(const Point<double>& p, size_t lobe, const Vec3& from, const Vec3& to) const;

  /// The factor that gives back what single scattering of metal or glass loses.
  template <class F>
  F scale(const EnergyTable& scales, const Point<F>& p, const Vec3Of<F>& w) const {
    return scales.at(abs(w.z), stretched_ ? roughness_along(p.facets, w) : p.roughness);
  }
  /// The reflectance of the dielectric's interface, with the film's, by the cosine above it.
  Spectrum interface_reflectance(const Colors& colors, double cosine, double fresnel) const;
  /// What a thin pane reflects and transmits, with all reflections between its two interfaces.
  struct Pane {
    Spectrum reflected, transmitted;
  };
  Pane pane(const Colors& colors, const Spectrum& interface, double cosine) const;
  /// The cosine in the coat.
  double cosine_in_coat(double cosine) const {
    return std::sqrt(std::max(1e-4, 1 - (1 - sqr(cosine)) / sqr(textures_.coat_ior)));
  }
  /// What is left of light on this many times its path through the coat along the normal.
  Spectrum through_coat(const Colors& colors, double path) const;
  /// The roughness of the lobe that reflects most.
  double roughness_of(const Colors& colors, const Point<double>& p,
                      const Terms<double>& terms) const;

  OpenPbrTextures textures_;
  double eta_;  ///< n_below / n_above of the base.
  std::optional<ThinFilm> film_;
  bool transmits_;                               ///< Whether light enters the dielectric.
  std::shared_ptr<const BalancedScales> glass_;  ///< If it is a solid.
  double base_weight_;                           ///< How bright the base's colour is in the mean.

 private:
  template <class F>
  F glossy_share(const Point<F>& p, F cosine) const {
    return p.gloss *
           (gloss_row_ ? gloss_row_->at(cosine) : energy_->reflectance.at(cosine, p.roughness));
  }
  template <class F>
  F diffuse_scale(const Point<F>& p) const;
  Spectrum under_film(const Colors& colors, const Terms<double>& terms) const;
  Spectrum darkening(const SurfacePoint& at, const Spectrum& base, double weight) const;

  bool refracts_ = false;  ///< Whether it is a solid that light enters.
  bool thin_, coated_, fuzzy_, metallic_, rough_base_, stretched_, coat_tints_;
  std::optional<EnergyRow> gloss_row_;  ///< The row of energy_, if the roughness is constant.
  double gloss_mean_ = 0;               ///< Likewise.
  double metal_weight_, fuzz_weight_, mean_fresnel_ = 0, coat_mean_fresnel_ = 0;
  std::shared_ptr<const InterfaceEnergy> energy_, coat_energy_;
};

}  // namespace mlt
