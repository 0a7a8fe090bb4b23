// A smooth layer of varnish above another material (Weidlich & Wilkie 2007, "Arbitrarily layered
// micro-facet surfaces", as in Mitsuba 0.6): light is mirrored by the layer with the fraction F;
// the rest is refracted, meets the material, and leaves through the layer again:
//   f(wl, wc) = T(wl) T(wc) exp(-a d (1 / |cos_l'| + 1 / |cos_c'|)) f'(wl', wc') / eta^2
// with T = 1 - F, absorption a, thickness d, and the refracted directions wl', wc'. Light that the
// layer reflects back to the material is lost. A material that transmits light has the layer on
// both sides.
#include "base/registry.h"
#include "scene/bsdf/bsdf.h"
#include "scene/bsdf/coat_layer.h"
#include "scene/nested.h"

namespace mlt {
namespace {

class Coating final : public Bsdf {
 public:
  explicit Coating(Params& params) : layer_(params), nested_(only_nested<Bsdf>(params, "bsdf")) {
    if (nested_->has_passage())
      params.fail("cannot hold a bsdf through which light goes straight on");
    if (nested_->has_delta() && nested_->bends_normal())
      params.fail("cannot hold a bsdf that reflects light like a mirror of another normal");
  }

  Scattering scattering(const SurfacePoint& at, const Vec3& wl, const Vec3& wc,
                        Lobe lobe) const override {
    if (wl.z * wc.z == 0) return {};
    const CoatLayer::Inside l = layer_.inside(wl), c = layer_.inside(wc);
    const double pl = layer_.specular_share(l.F), pc = layer_.specular_share(c.F);
    Scattering s{};
    if (l.F < 1 && c.F < 1) {
      s = nested_->scattering(at, l.w, c.w, lobe);
      s.f *= (1 - l.F) * (1 - c.F) * layer_.transmittance(at, l.w, c.w);
      s.pdf_from_light *= 1 - pl;
      s.pdf_from_camera *= 1 - pc;
      if (lobe == Lobe::smooth) {
        s.f /= sqr(layer_.eta());
        s.pdf_from_light *= layer_.compression(wc, c.w);
        s.pdf_from_camera *= layer_.compression(wl, l.w);
      }
    }
    if (lobe != Lobe::reflection || !same_side(wl, wc)) return s;
    return {s.f + l.F * layer_.reflectance(at), s.pdf_from_light + pl, s.pdf_from_camera + pc};
  }

  std::optional<BsdfSample> sample(const SurfacePoint& at, const Vec3& from,
                                   const Vec3& u) const override {
    if (from.z == 0) return std::nullopt;
    const CoatLayer::Inside in = layer_.inside(from);
    const double p = layer_.specular_share(in.F);
    if (u.x < p) return BsdfSample{reflect(from), Lobe::reflection};
    auto sampled = nested_->sample(at, in.w, {(u.x - p) / (1 - p), u.y, u.z});
    if (!sampled) return std::nullopt;
    if (sampled->lobe == Lobe::reflection) {
      sampled->to = reflect(from);
      return sampled;
    }
    const auto out = layer_.outside(sampled->to);
    if (!out) return std::nullopt;
    sampled->to = *out;
    return sampled;
  }

  std::optional<Vec3> invert(const SurfacePoint& at, const Vec3& from, const Vec3& to, Lobe lobe,
                             const Vec3& v) const override {
    const double total = pdf(at, from, to, lobe);
    if (!(total > 0)) return std::nullopt;
    const CoatLayer::Inside in = layer_.inside(from);
    const double p = layer_.specular_share(in.F), first = lobe == Lobe::reflection ? p : 0;
    const LobeGuess guess = guess_lobe(first, std::max(0.0, total - first), v.x);
    if (guess.first) return Vec3(u_of_first(p, guess.rest), v.y, v.z);
    auto u = nested_->invert(at, in.w, layer_.inside(to).w, lobe, {guess.rest, v.y, v.z});
    if (u) u->x = u_of_second(p, u->x);
    return u;
  }

  bool has_smooth() const override { return nested_->has_smooth(); }
  bool has_delta() const override { return true; }
  bool has_transmission() const override { return nested_->has_transmission(); }
  /// By Snell's law on both sides of the nested interface, the layer cancels.
  double relative_eta(const SurfacePoint& at, const Vec3& w) const override {
    return nested_->relative_eta(at, w);
  }
  double roughness(const SurfacePoint& at, const Vec3& wl, const Vec3& wc) const override {
    return nested_->roughness(at, layer_.inside(wl).w, layer_.inside(wc).w);
  }
  Spectrum albedo(const SurfacePoint& at) const override {
    const double F = layer_.inside({0, 0, 1}).F;
    return F * layer_.reflectance(at) + sqr(1 - F) * nested_->albedo(at);
  }

 private:
  CoatLayer layer_;
  BsdfPtr nested_;
};

}  // namespace

Plugin bsdf_coating() {
  Plugin plugin =
      make_plugin<Coating>("bsdf", "coating", "A smooth layer of varnish above the nested bsdf.",
                           CoatLayer::parameters());
  plugin.schema.reciprocal = false;  // the nested one may refract
  return plugin;
}

}  // namespace mlt
