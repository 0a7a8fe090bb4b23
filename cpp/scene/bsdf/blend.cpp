#include "scene/bsdf/blend.h"

#include "scene/bsdf/lobes.h"

namespace mlt {
namespace {

/// Whether a material refracts, rather than letting light straight through.
bool refracts(const Bsdf& part) {
  const Vec3 up(0, 0, 1);
  return part.has_transmission() &&
         (part.relative_eta({}, up) != 1 || part.pdf({}, up, -up, Lobe::transmission) > 0);
}

}  // namespace

Blend::Blend(BsdfPtr first, BsdfPtr second, TexturePtr weight, double scale, const Params& params)
    : first_(std::move(first)),
      second_(std::move(second)),
      weight_(std::move(weight)),
      scale_(scale),
      first_refracts_(refracts(*first_)) {
  const Vec3 up(0, 0, 1);
  if (first_refracts_ && refracts(*second_) &&
      first_->relative_eta({}, up) != second_->relative_eta({}, up))
    params.fail("cannot blend two bsdfs that refract light differently");
  if (first_ != second_ && first_->has_delta() && second_->has_delta() && bends_normal())
    params.fail("cannot blend two bsdfs that reflect light like mirrors of different normals");
}

Passage Blend::passage(const SurfacePoint& at, const Vec3& w) const {
  const Passage a = first_->passage(at, w), b = second_->passage(at, w);
  const double s = weight(at);
  return {scale_ * ((1 - s) * a.transmittance + s * b.transmittance),
          (1 - s) * a.probability + s * b.probability};
}

double Blend::probability_of_first(const SurfacePoint& at, const Vec3& from) const {
  const double w = weight(at);
  if (!has_passage()) return 1 - w;
  return first_share((1 - w) * (1 - first_->passage(at, from).probability),
                     w * (1 - second_->passage(at, from).probability));
}

Scattering Blend::scattering(const SurfacePoint& at, const Vec3& wl, const Vec3& wc,
                             Lobe lobe) const {
  const Scattering a = first_->scattering(at, wl, wc, lobe);
  const Scattering b = second_->scattering(at, wl, wc, lobe);
  const auto blend = [](double p, const auto& x, const auto& y) { return p * x + (1 - p) * y; };
  return {scale_ * blend(1 - weight(at), a.f, b.f),
          blend(probability_of_first(at, wl), a.pdf_from_light, b.pdf_from_light),
          blend(probability_of_first(at, wc), a.pdf_from_camera, b.pdf_from_camera),
          a.disperses || b.disperses};
}

std::optional<BsdfSample> Blend::sample(const SurfacePoint& at, const Vec3& from,
                                        const Vec3& u) const {
  const double p = probability_of_first(at, from);
  if (u.x < p) return first_->sample(at, from, {u.x / p, u.y, u.z});
  return second_->sample(at, from, {(u.x - p) / (1 - p), u.y, u.z});
}

std::optional<Vec3> Blend::invert(const SurfacePoint& at, const Vec3& from, const Vec3& to,
                                  Lobe lobe, const Vec3& v) const {
  const double p = probability_of_first(at, from);
  const double first = p * first_->pdf(at, from, to, lobe),
               second = (1 - p) * second_->pdf(at, from, to, lobe);
  if (!(first + second > 0)) return std::nullopt;
  const LobeGuess guess = guess_lobe(first, second, v.x);
  auto u = (guess.first ? first_ : second_)->invert(at, from, to, lobe, {guess.rest, v.y, v.z});
  if (u) u->x = guess.first ? u_of_first(p, u->x) : u_of_second(p, u->x);
  return u;
}

double Blend::relative_eta(const SurfacePoint& at, const Vec3& w) const {
  return (first_refracts_ ? *first_ : *second_).relative_eta(at, w);
}

Vec3 Blend::delta_normal(const SurfacePoint& at, const Vec3& w) const {
  return (first_->has_delta() ? *first_ : *second_).delta_normal(at, w);
}

/// The roughness of the part that scatters more between these directions.
double Blend::roughness(const SurfacePoint& at, const Vec3& wl, const Vec3& wc) const {
  const auto strength = [&](const Bsdf& part) {
    return target_luminance(part.eval(at, wl, wc, Lobe::smooth));
  };
  const double w = weight(at);
  return ((1 - w) * strength(*first_) >= w * strength(*second_) ? *first_ : *second_)
      .roughness(at, wl, wc);
}

Spectrum Blend::albedo(const SurfacePoint& at) const {
  const double w = weight(at);
  return scale_ * ((1 - w) * first_->albedo(at) + w * second_->albedo(at));
}

}  // namespace mlt
