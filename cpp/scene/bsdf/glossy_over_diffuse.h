// The base of models that add a glossy lobe to a diffuse part, which does not depend on the light
// that the lobe leaves over: f = k_d / pi + k_s lobe.
#pragma once

#include "base/params.h"
#include "scene/bsdf.h"
#include "scene/texture.h"

namespace mlt {

class GlossyOverDiffuse : public Bsdf {
 public:
  static std::vector<Parameter> parameters();
  explicit GlossyOverDiffuse(Params& params);

  Scattering scattering(const SurfacePoint& at, const Vec3& wl, const Vec3& wc,
                        Lobe lobe) const final;
  std::optional<BsdfSample> sample(const SurfacePoint& at, const Vec3& from,
                                   const Vec3& u) const final;
  std::optional<Vec3> invert(const SurfacePoint& at, const Vec3& from, const Vec3& to, Lobe lobe,
                             const Vec3& v) const final;
  double roughness(const SurfacePoint& at, const Vec3& wl, const Vec3& wc) const final;
  Spectrum albedo(const SurfacePoint& at) const final;

 protected:
  /// The glossy lobe alone: its value, and its densities in solid angle. Both directions are above.
  struct Gloss {
    double f, pdf_from_light, pdf_from_camera;
  };
  virtual Gloss gloss(const SurfacePoint& at, const Vec3& wl, const Vec3& wc) const = 0;
  virtual Vec3 sample_gloss(const SurfacePoint& at, const Vec3& from, const Vec2& u) const = 0;
  virtual Vec2 invert_gloss(const SurfacePoint& at, const Vec3& from, const Vec3& to) const = 0;
  virtual double gloss_roughness(const SurfacePoint& at) const = 0;

 private:
  Spectrum diffuse_part(const SurfacePoint& at) const;
  Spectrum glossy_part(const SurfacePoint& at, const Gloss& gloss) const;
  double diffuse_pdf(const Vec3& to) const;

  TexturePtr diffuse_, specular_;
  double scale_ = 1;  ///< Factor of both parts, for energy conservation.
  double specular_share_;
};

}  // namespace mlt
