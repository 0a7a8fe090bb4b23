// What scatters light at a point: on a surface the Lambertian that it is there, or its plug-in; in
// a medium its phase function. Directions are unit vectors in the world, unless they are called
// local.
#pragma once

#include "scene/scene.h"

namespace mlt {

/// Scattering between two directions, and their cosines against the shading normal; for a delta
/// lobe, against the normal about which it reflects or refracts.
struct WorldScattering : Scattering {
  double cos_l, cos_c;
};

/// A direction that a BSDF has sampled, and its lobe.
struct ScatteredDirection {
  Vec3 w;
  Vec3 from, to;  ///< Local: to the previous vertex (z alone if Lambertian), and w.
  Lobe lobe;
};

class BsdfAt {
 public:
  BsdfAt(const Scene& scene, const SurfacePoint& at) : scene_(&scene), at_(&at) {}

  bool has_smooth() const { return lambertian().known() || plugin().has_smooth(); }
  bool has_delta() const { return !lambertian().known() && plugin().has_delta(); }
  /// Whether the density of scattering into a direction depends on no other direction, but for its
  /// side: then it is known as soon as a walk arrives.
  bool knows_density() const { return lambertian().known(); }

  WorldScattering scattering(const Vec3& wl, const Vec3& wc, Lobe lobe) const {
    if (lambertian().known()) {
      const Vec3& n = at_->shading.n;
      const double cos_l = dot(wl, n), cos_c = dot(wc, n);
      return {lambertian().scattering(cos_l, cos_c, lobe), cos_l, cos_c};
    }
    if (at_->in_medium()) return {in_medium(wl, wc, lobe), 1, 1};
    return on_surface(wl, wc, lobe);
  }
  /// The scattering between two local directions.
  Scattering local_scattering(const Vec3& wl, const Vec3& wc, Lobe lobe) const {
    if (at_->in_medium()) return in_medium(wl, wc, lobe);
    return lambertian().known() ? lambertian().scattering(wl.z, wc.z, lobe)
                                : plugin().scattering(*at_, wl, wc, lobe);
  }
  /// |cos| of a local direction; 1 in a medium.
  double abs_cos(const Vec3& w) const { return at_->in_medium() ? 1 : abs_cos_theta(w); }

  /// Samples a direction: u.x chooses the lobe, (u.y, u.z) the direction; nullopt if there is none.
  std::optional<ScatteredDirection> sample(const Vec3& from, const Vec3& u) const {
    const Frame& shading = at_->shading;
    if (lambertian().known()) {
      const double cos_from = dot(from, shading.n);
      const auto to = lambertian().sample(cos_from, {u.y, u.z});
      if (!to) return std::nullopt;
      return ScatteredDirection{shading.to_world(*to), {0, 0, cos_from}, *to, Lobe::smooth};
    }
    const Vec3 local_from = shading.to_local(from);
    const auto sample = plugin().sample(*at_, local_from, u);
    if (!sample) return std::nullopt;
    return ScatteredDirection{shading.to_world(sample->to), local_from, sample->to, sample->lobe};
  }

  /// Whether its narrowest smooth lobe between these directions has a roughness below this one.
  bool smoother_than(double roughness, const Vec3& wl, const Vec3& wc) const {
    if (lambertian().known() || roughness <= 0) return false;
    const Bsdf& bsdf = plugin();
    if (bsdf.least_roughness() >= roughness) return false;
    return bsdf.roughness(*at_, at_->shading.to_local(wl), at_->shading.to_local(wc)) < roughness;
  }
  /// See Bsdf::relative_eta; w is local.
  double relative_eta(const Vec3& w) const { return plugin().relative_eta(*at_, w); }

 private:
  // Not inlined: what most surfaces need of scattering() should be.

  /// The scattering by the surface's plug-in, in world space.
  [[gnu::noinline]] WorldScattering on_surface(const Vec3& wl, const Vec3& wc, Lobe lobe) const {
    const Bsdf& bsdf = plugin();
    const Frame& shading = at_->shading;
    const Vec3 local_l = shading.to_local(wl), local_c = shading.to_local(wc);
    const Scattering s = bsdf.scattering(*at_, local_l, local_c, lobe);
    if (lobe == Lobe::smooth || !bsdf.bends_normal()) return {s, local_l.z, local_c.z};
    const Vec3 n = bsdf.delta_normal(*at_, local_l);
    const double cos_l = dot(local_l, n);
    return {s, cos_l, lobe == Lobe::reflection ? cos_l : dot(local_c, n)};
  }
  /// sigma_s times the phase function.
  [[gnu::noinline]] Scattering in_medium(const Vec3& wl, const Vec3& wc, Lobe lobe) const {
    Scattering s = plugin().scattering(*at_, wl, wc, lobe);
    s.f *= scene_->medium(*at_).at(at_->p, at_->wavelength).scattering;
    return s;
  }
  const Lambertian& lambertian() const { return at_->lambertian; }
  const Bsdf& plugin() const { return scene_->bsdf(*at_); }

  const Scene* scene_;
  const SurfacePoint* at_;
};

}  // namespace mlt
