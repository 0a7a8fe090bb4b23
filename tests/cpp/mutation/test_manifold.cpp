// The derivatives of specular chains, their density and the walk that follows them, by finite
// differences: the end of a chain is moved a little, and the chain is found again.
#include "mutation/mutation_testing.h"
#include "path/half_vector.h"
#include "path/manifold_walk.h"
#include "scene/shape/normal_gradient.h"

namespace mlt::test {
namespace {

/// A chain of specular vertices between vertex c and vertex b of a path.
struct Span {
  int c, b;
};

std::vector<Span> specular_spans(const PathState& x) {
  std::vector<Span> spans;
  for (int c = 0, b = 1; b < x.edges(); ++b) {
    if (x.specular(b)) continue;
    if (b - c > 1) spans.push_back({c, b});
    c = b;
  }
  return spans;
}

/// Calls see(x, span) for such chains of paths of the scene.
template <class See>
void for_each_chain(const PathTarget& target, int samples, See&& see) {
  for_each_light_path(target, 5, samples, [&](const PathState& x) {
    if (!(x.target > 0)) return;
    for (const Span& span : specular_spans(x)) {
      bool known = span.b - span.c - 1 <= SpecularChain::most_vertices;
      for (int i = span.c + 1; i < span.b; ++i)
        known = known && has_constraint(target.scene(), x[i]);
      if (known) see(x, span);
    }
  });
}

/// Scenes whose chains reflect and refract, at deltas and nearly so, on spheres, meshes with
/// normals and without, and instances; with lights of every kind.
std::vector<std::string> scenes_of_chains() {
  return {"caustic",        "mirrors",      "near_specular",     "near_specular_mirrors",
          "point_caustic",  "smooth_glass", "light_under_water", "spinning_instance",
          "window_caustic", "sun_caustic",  "glass_torus"};
}

class SpecularChains : public testing::TestWithParam<std::string> {};

/// Where the first ray of the chain goes when its end is at `end`: its direction, or for a light at
/// infinity the point of the plane across it.
std::optional<Vec3> first_ray(const Scene& scene, const PathState& x, const Span& span,
                              const SurfacePoint& end, Vec3& first) {
  ManifoldWalk walk;
  RayCounts rays;
  if (!walk.start(scene, &x[span.c], span.b - span.c - 1) || !walk.go(end, x.path.time, rays))
    return std::nullopt;
  first = walk[0].at.p;
  if (!x[span.c].at.infinite()) return direction(x[span.c].at, walk[0].at);
  return first - x[0].at.p * dot(first, x[0].at.p);
}

TEST_P(SpecularChains, MoveAsTheirDerivativesSay) {
  const ScenePtr scene = make_scene(GetParam()).scene;
  const PathTarget target = path_target(scene);
  int tested = 0, wrong_moves = 0, wrong_densities = 0;
  for_each_chain(target, 3000, [&](const PathState& x, const Span& span) {
    const SurfacePoint& b = x[span.b].at;
    const SpecularChain chain(*scene, &x[span.c], span.b - span.c - 1);
    const Frame plane = Frame::around(b.ng);
    const double step = 1e-4 * x.terms[span.b - 1].distance;
    Vec3 by_plane[2];
    bool right = true;
    for (int axis = 0; axis < 2; ++axis) {
      const Vec3 move = step * (axis == 0 ? plane.s : plane.t);
      SurfacePoint ends[2] = {b, b};
      ends[0].p -= move;
      ends[1].p += move;
      Vec3 first[2];
      const auto low = first_ray(*scene, x, span, ends[0], first[0]);
      const auto high = first_ray(*scene, x, span, ends[1], first[1]);
      if (!low || !high) return;
      by_plane[axis] = (*high - *low) / (2 * step);
      const Vec3 expected = chain.first_move(move), found = 0.5 * (first[1] - first[0]);
      right = right && length(found - expected) <= 0.01 * length(expected);
    }
    ++tested;
    wrong_moves += !right;
    // G of the whole chain, d omega_c / dA_b in projected solid angle, and the product of its G.
    const double G = length(cross(by_plane[0], by_plane[1])) *
                     (x[span.c].at.infinite() ? 1 : abs_cos(x[span.c].at, x.terms[span.c].w));
    double product = 1;
    for (int i = span.c; i < span.b; ++i) {
      product *= x.terms[i].G;
      if (i == span.c || x[i].delta()) continue;
      const Frame& frame = x[i].at.shading;
      const Vec3 in = frame.to_local(x.terms.direction(i, -1)), out = frame.to_local(x.terms[i].w);
      const double eta = scene->bsdf(x[i].at).relative_eta(x[i].at, in);
      const Vec3 h = *half_vector(in, out, eta);
      product *=
          half_vector_jacobian(in, out, h, eta) * std::abs(h.z) / abs_cos(x[i].at, x.terms[i].w);
    }
    wrong_densities += std::abs(product / (G * chain.density()) - 1) > 0.02;
  });
  // Edges of triangles, and where a surface is met at a grazing angle.
  EXPECT_GT(tested, 100);
  EXPECT_LT(wrong_moves, 0.03 * tested) << tested;
  EXPECT_LT(wrong_densities, 0.02 * tested) << tested;
}

/// The tilt of the shading normal along each surface, by two rays that hit it side by side.
TEST_P(SpecularChains, KnowHowNormalsTurn) {
  const ScenePtr scene = make_scene(GetParam()).scene;
  const PathTarget target = path_target(scene);
  int tested = 0, wrong = 0;
  for_each_light_path(target, 6, 1000, [&](const PathState& x) {
    for (int i = 1; i < x.edges(); ++i) {
      const SurfacePoint& at = x[i].at;
      const Mat3 gradient = normal_gradient(*scene, at);
      const double step = 1e-4;
      for (const Vec3& along : {Frame::around(at.ng).s, Frame::around(at.ng).t}) {
        const Ray ray{at.p + along * step + at.ng * 0.01, -at.ng, x.path.time};
        SurfacePoint other;
        if (!scene->intersect(ray, other) || other.shape != at.shape ||
            other.primitive != at.primitive || other.instance != at.instance ||
            length(other.p - at.p) > 0.01)
          continue;
        const Vec3 turned = (other.shading.n - at.shading.n) / step;
        const Vec3 expected = gradient * ((other.p - at.p) / step);
        ++tested;
        wrong += length(turned - expected) > 0.02 * length(expected) + 1e-4;
      }
    }
  });
  EXPECT_GT(tested, 1000);
  EXPECT_LT(wrong, 0.005 * tested) << tested;
}

INSTANTIATE_TEST_SUITE_P(Scenes, SpecularChains, testing::ValuesIn(scenes_of_chains()),
                         [](const auto& info) { return info.param; });

}  // namespace
}  // namespace mlt::test
