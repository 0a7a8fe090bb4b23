// The surface of one of several solids that overlap: its material as it is in what is around it,
// or nothing, where it lies in a solid of higher priority.
#pragma once

#include "scene/bsdf/bsdf.h"

#include <vector>

namespace mlt {

class SolidSurface final : public Bsdf {
 public:
  /// `immersed`: the material in each of the solids.
  SolidSurface(BsdfPtr alone, std::vector<BsdfPtr> immersed)
      : alone_(std::move(alone)), immersed_(std::move(immersed)) {
    where = alone_->where;
    type = alone_->type;
  }

  /// The material itself, of a shape that has been in another scene, too.
  static BsdfPtr alone(const BsdfPtr& bsdf) {
    const auto solid = std::dynamic_pointer_cast<const SolidSurface>(bsdf);
    return solid ? solid->alone_ : bsdf;
  }

  Passage passage(const SurfacePoint& at, const Vec3& w) const override {
    return is_hidden(at) ? Passage{} : in_place(at).passage(at, w);
  }
  bool has_passage() const override { return true; }

  Scattering scattering(const SurfacePoint& at, const Vec3& wl, const Vec3& wc,
                        Lobe lobe) const override {
    return is_hidden(at) ? Scattering{} : in_place(at).scattering(at, wl, wc, lobe);
  }
  std::optional<BsdfSample> sample(const SurfacePoint& at, const Vec3& from,
                                   const Vec3& u) const override {
    return is_hidden(at) ? std::nullopt : in_place(at).sample(at, from, u);
  }
  std::optional<Vec3> invert(const SurfacePoint& at, const Vec3& from, const Vec3& to, Lobe lobe,
                             const Vec3& v) const override {
    return is_hidden(at) ? std::nullopt : in_place(at).invert(at, from, to, lobe, v);
  }

  bool has_smooth() const override { return alone_->has_smooth(); }
  bool has_delta() const override { return alone_->has_delta(); }
  bool has_transmission() const override { return true; }
  double relative_eta(const SurfacePoint& at, const Vec3& w) const override {
    return is_hidden(at) ? 1 : in_place(at).relative_eta(at, w);
  }
  double roughness(const SurfacePoint& at, const Vec3& wl, const Vec3& wc) const override {
    return is_hidden(at) ? infinity : in_place(at).roughness(at, wl, wc);
  }
  double least_roughness() const override { return alone_->least_roughness(); }
  Vec3 delta_normal(const SurfacePoint& at, const Vec3& w) const override {
    return in_place(at).delta_normal(at, w);
  }
  bool bends_normal() const override { return alone_->bends_normal(); }
  Spectrum albedo(const SurfacePoint& at) const override {
    return is_hidden(at) ? Spectrum(1) : in_place(at).albedo(at);
  }
  const SideIndex* index_inside() const override { return alone_->index_inside(); }

 private:
  static bool is_hidden(const SurfacePoint& at) { return at.around == hidden_surface; }
  const Bsdf& in_place(const SurfacePoint& at) const {
    return at.around < immersed_.size() ? *immersed_[at.around] : *alone_;
  }

  BsdfPtr alone_;
  std::vector<BsdfPtr> immersed_;
};

}  // namespace mlt
