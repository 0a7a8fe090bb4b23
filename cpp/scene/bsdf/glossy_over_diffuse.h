// Models that add a glossy lobe to a diffuse part, which does not depend on the light that the lobe
// leaves over: f = k_d / pi + k_s lobe. `Lobes` are those of all points:
//
//   Lobe      at<F>(at)         that of one point, or of eight; at is an array of pointers
//   double    typical_alpha()   the roughness where textures have their means
//
// and a Lobe, whose densities do not depend on which of its directions is sampled, has
//
//   Gloss<F>  eval(wl, wc)
//   Vec3Of<F> sample(from, u)
//   Vec2      invert(from, to)
//   F         least_alpha()     its roughness
#pragma once

#include "base/params.h"
#include "math/warp.h"
#include "scene/bsdf/smooth_reflector.h"
#include "scene/texture/texture.h"

namespace mlt {

/// The glossy lobe alone: its value, and its density in solid angle.
template <class F>
struct Gloss {
  F f, pdf;
};

/// The reflectances of both parts.
struct GlossyReflectances {
  TexturePtr diffuse, specular;
  double scale = 1;  ///< Factor of both parts, for energy conservation.
  double specular_share;

  static std::vector<Parameter> parameters();
  explicit GlossyReflectances(Params& params);
};

template <class Lobes>
class GlossyOverDiffuse final : public SmoothReflector<GlossyOverDiffuse<Lobes>> {
  using Base = SmoothReflector<GlossyOverDiffuse>;

 public:
  explicit GlossyOverDiffuse(Params& params) : lobes_(params), reflectances_(params) {
    this->supports_lanes_ = lobes_.typical_alpha() >= least_alpha_in_lanes;
  }

  template <class F>
  auto point(const SurfacePoint* const* at) const {
    return lobes_.template at<F>(at);
  }

  template <class F>
  struct Terms {
    F gloss, pdf_from_light, pdf_from_camera;
    Terms<double> of_lane(int i) const { return {gloss[i], 0, 0}; }
  };
  template <class LobeOfPoint, class F>
  Terms<F> terms(const LobeOfPoint& lobe, const Vec3Of<F>& wl, const Vec3Of<F>& wc) const {
    const Gloss<F> gloss = lobe.eval(wl, wc);
    const F pdf = number<F>(specular_share()) * gloss.pdf;
    return {gloss.f, diffuse_pdf(wc) + pdf, diffuse_pdf(wl) + pdf};
  }

  template <class LobeOfPoint, class F>
  Vec3Of<F> direction(const LobeOfPoint& lobe, const Vec3Of<F>& from, const Vec3Of<F>& u) const {
    const Vec2Of<F> v(u.y, u.z);
    const auto is_glossy = u.x < number<F>(specular_share());
    if constexpr (is_number<F>)
      return is_glossy ? lobe.sample(from, v) : sample_cosine_hemisphere(v);
    else
      return select(is_glossy, lobe.sample(from, v), sample_cosine_hemisphere(v));
  }

  struct Colors {
    Spectrum diffuse, specular;
  };
  Colors colors(const SurfacePoint& at) const {
    const double scale = reflectances_.scale;
    return {scale * inv_pi * reflectances_.diffuse->eval(at),
            scale * reflectances_.specular->eval(at)};
  }
  Spectrum value(const Colors& colors, const Terms<double>& terms) const {
    return colors.diffuse + terms.gloss * colors.specular;
  }

  std::optional<Vec3> invert(const SurfacePoint& at, const Vec3& from, const Vec3& to, Lobe lobe,
                             const Vec3& v) const override {
    if (lobe != Lobe::smooth || !above(from, to)) return std::nullopt;
    const auto gloss = Base::point(at);
    const double glossy = specular_share() * gloss.eval(from, to).pdf;
    const double lambertian = diffuse_pdf(to);
    if (!(glossy + lambertian > 0)) return std::nullopt;
    const LobeGuess guess = guess_lobe(glossy, lambertian, v.x);
    if (guess.first) return u_of(u_of_first(specular_share(), guess.rest), gloss.invert(from, to));
    return u_of(u_of_second(specular_share(), guess.rest), invert_cosine_hemisphere(to));
  }

  /// The roughness of the larger part: of the lobe, or that of a diffuse surface.
  double roughness(const SurfacePoint& at, const Vec3& wl, const Vec3& wc) const override {
    if (!above(wl, wc)) return infinity;
    const auto lobe = Base::point(at);
    const Colors colors = this->colors(at);
    const double glossy = target_luminance(lobe.eval(wl, wc).f * colors.specular);
    return glossy > target_luminance(colors.diffuse) ? lobe.least_alpha() : infinity;
  }

  Spectrum albedo(const SurfacePoint& at) const override {
    return reflectances_.scale *
           (reflectances_.diffuse->eval(at) + reflectances_.specular->eval(at));
  }

 private:
  double specular_share() const { return reflectances_.specular_share; }
  template <class F>
  F diffuse_pdf(const Vec3Of<F>& to) const {
    return number<F>((1 - specular_share()) * inv_pi) * to.z;
  }

  Lobes lobes_;
  GlossyReflectances reflectances_;
};

}  // namespace mlt
