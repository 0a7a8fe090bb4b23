#include "mutation/image_footprint.h"

#include "mutation/path_state.h"
#include "path/specular_chain.h"

namespace mlt {
namespace {

/// Largest ratio of the axes; beyond, the chain's end is near a focus, where a linear map fails.
constexpr double most_anisotropy = 30;

/// The move of x_{k-1} on its surface whose projection along the view is `across`.
Vec3 move_on_surface(const PathState& x, const Vec3& across) {
  const int k = x.edges();
  const Vec3 view = x.terms.direction(k, -1), normal = x[k - 1].at.ng;
  return across - view * (dot(normal, across) / dot(normal, view));
}

bool has_constraints(const Scene& scene, const PathState& x, int first, int end) {
  for (int i = first; i < end; ++i)
    if (!has_constraint(scene, x[i])) return false;
  return end - first <= SpecularChain::most_vertices;
}

/// Whether the ellipse a cos t + b sin t is not too far from round: for its axes p and q,
/// p / q + q / p = (|a|^2 + |b|^2) / |det(a, b)|.
bool nearly_round(const Vec2& a, const Vec2& b) {
  return glm::dot(a, a) + glm::dot(b, b) <
         (most_anisotropy + 1 / most_anisotropy) * std::abs(a.x * b.y - a.y * b.x);
}

}  // namespace

std::optional<ImageFootprint> ImageFootprint::of(const Scene& scene, const PathState& x, int a,
                                                 double pixel_angle) {
  const int k = x.edges(), count = k - 2 - a;
  if (!has_constraints(scene, x, a + 1, k - 1)) return std::nullopt;
  const std::optional<SpecularChain> chain =
      count > 0 ? std::optional<SpecularChain>({scene, &x[a], count}) : std::nullopt;
  if (chain && chain->density() == 0) return std::nullopt;
  const Frame view = Frame::around(x.terms.direction(k, -1)), around = Frame::around(x.terms[a].w);
  const auto turn = [&](const Vec3& axis) {
    const Vec3 end = move_on_surface(x, axis * (pixel_angle * x.terms[k - 1].distance));
    const Vec3 first = chain ? chain->first_move(end) : end;
    return Vec2(dot(around.s, first), dot(around.t, first)) / x.terms[a].distance;
  };
  const Vec2 s = turn(view.s), t = turn(view.t);
  if (!nearly_round(s, t)) return std::nullopt;
  return ImageFootprint(around, {s, t});
}

Vec3 ImageFootprint::perturb(const ExponentialRadius& pixels, Rng& rng) const {
  const double r = pixels.sample(rng.next()), phi = 2 * pi * rng.next();
  const Vec2 turn = turn_ * (r * Vec2(std::cos(phi), std::sin(phi)));
  return normalize(around_.to_world({turn.x, turn.y, 1}));
}

double ImageFootprint::pdf(const Vec3& w, const ExponentialRadius& pixels) const {
  const Vec3 local = around_.to_local(w);
  if (!(local.z > 0)) return 0;
  const double r = glm::length(pixels_ * (Vec2(local.x, local.y) / local.z));
  return pixels.planar_pdf(r) * std::abs(glm::determinant(pixels_)) / (sqr(local.z) * local.z);
}

}  // namespace mlt
