// A weighted sum of two materials: s ((1 - w) f_1 + w f_2).
#pragma once

#include "base/params.h"
#include "scene/bsdf/bsdf.h"
#include "scene/texture/texture.h"

namespace mlt {

class Blend final : public Bsdf {
 public:
  /// `scale` is at most 1: the rest of the light is absorbed. Throws SceneError about the plug-in
  /// of `params` if the two cannot be blended.
  Blend(BsdfPtr first, BsdfPtr second, TexturePtr weight, double scale, const Params& params);

  Passage passage(const SurfacePoint& at, const Vec3& w) const override;
  bool has_passage() const override { return first_->has_passage() || second_->has_passage(); }

  Scattering scattering(const SurfacePoint& at, const Vec3& wl, const Vec3& wc,
                        Lobe lobe) const override;
  std::optional<BsdfSample> sample(const SurfacePoint& at, const Vec3& from,
                                   const Vec3& u) const override;
  std::optional<Vec3> invert(const SurfacePoint& at, const Vec3& from, const Vec3& to, Lobe lobe,
                             const Vec3& v) const override;

  bool has_smooth() const override { return first_->has_smooth() || second_->has_smooth(); }
  bool has_delta() const override { return first_->has_delta() || second_->has_delta(); }
  bool has_transmission() const override {
    return first_->has_transmission() || second_->has_transmission();
  }
  double relative_eta(const SurfacePoint& at, const Vec3& w) const override;
  Vec3 delta_normal(const SurfacePoint& at, const Vec3& w) const override;
  bool bends_normal() const override { return first_->bends_normal() || second_->bends_normal(); }
  double roughness(const SurfacePoint& at, const Vec3& wl, const Vec3& wc) const override;
  Spectrum albedo(const SurfacePoint& at) const override;

 private:
  double weight(const SurfacePoint& at) const { return weight_->eval_scalar(at); }
  /// The probability that light from this direction is scattered by the first material.
  double probability_of_first(const SurfacePoint& at, const Vec3& from) const;

  BsdfPtr first_, second_;
  TexturePtr weight_;
  double scale_;
  bool first_refracts_;  ///< Cached: nested blends would repeat the test.
};

}  // namespace mlt
