// A material on a surface whose shading normal is bent from place to place, by an image of normals
// or of heights. The nested material is evaluated in the frame of the bent normal N; the cosine
// that belongs to its f is the one with N, in both directions of light (Veach 1997, sec. 5.3).
//
// As in Mitsuba 3, N is turned around the shading normal, to (-N.x, -N.y, N.z), where the camera
// side would see it from behind (Schuessler et al. 2017, "Microfacet-based normal mapping for
// robust Monte Carlo path tracing"), and light that grazes a bent surface is dimmed (Conty Estevez,
// Lecocq & Stein 2019, "A microfacet-based shadowing function to solve the bump terminator
// problem"). Walks from the light do not know the direction to the camera: now and then they use
// the turned frame where N would do.
#pragma once

#include "base/params.h"
#include "scene/bsdf/bsdf.h"

namespace mlt {

class BentNormal : public Bsdf {
 public:
  explicit BentNormal(Params& params);

  Passage passage(const SurfacePoint& at, const Vec3& w) const final;
  bool has_passage() const final { return nested_->has_passage(); }

  Scattering scattering(const SurfacePoint& at, const Vec3& wl, const Vec3& wc,
                        Lobe lobe) const final;
  std::optional<BsdfSample> sample(const SurfacePoint& at, const Vec3& from,
                                   const Vec3& u) const final;
  void scatter(ScatteringLanes& x) const final;
  std::optional<Vec3> invert(const SurfacePoint& at, const Vec3& from, const Vec3& to, Lobe lobe,
                             const Vec3& v) const final;

  bool has_smooth() const final { return nested_->has_smooth(); }
  bool has_delta() const final { return nested_->has_delta(); }
  bool has_transmission() const final { return nested_->has_transmission(); }
  double relative_eta(const SurfacePoint& at, const Vec3& w) const final {
    return nested_->relative_eta(at, w);
  }
  double least_roughness() const final { return nested_->least_roughness(); }
  double roughness(const SurfacePoint& at, const Vec3& wl, const Vec3& wc) const final;
  Vec3 delta_normal(const SurfacePoint& at, const Vec3& w) const final;
  bool bends_normal() const final { return true; }
  Spectrum albedo(const SurfacePoint& at) const final { return nested_->albedo(at); }

 protected:
  /// N in the shading frame, a unit vector.
  virtual Vec3 normal(const SurfacePoint& at) const = 0;

 private:
  class Bend;

  /// The probability that a sample for the direction w uses the turned normal.
  double turned_share(const Vec3& n, const Vec3& w) const;
  /// Whether light is scattered between a and b in the frame of N, or of N turned around: N is
  /// turned for both or for none, and both are on the same side of the surface and of the bent one.
  /// Mirrors do not use the turned frame, so that each has one normal at each point.
  bool scatters(const Vec3& n, bool turned, const Vec3& a, const Vec3& b, Lobe lobe) const;
  /// The factor of the nested material's f: the ratio of cosines, unless f has none, and shadowing.
  double factor(const Bend& bend, const Vec3& wl, Lobe lobe) const;

  BsdfPtr nested_;
  bool flips_, shadows_;
};

/// The schema of such a material: `parameters`, and those that BentNormal reads.
Schema bent_normal_schema(const std::string& name, const std::string& doc,
                          std::vector<Parameter> parameters);

}  // namespace mlt
