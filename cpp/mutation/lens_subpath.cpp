// The lens subpath mutation (Veach 1997, sec. 11.3.4): the camera end of the path is replaced by a
// fresh one, for paths of the form ...(L|D)DS*E. A new point on the lens and a new image position
// are drawn, the walk goes on over (nearly) specular surfaces by sampling their BSDFs, and the
// vertex where it stops is connected to the rest of the path.
#include "mutation/edge_visibility.h"
#include "mutation/measured_mutation.h"
#include "mutation/mutation_registry.h"

namespace mlt {
namespace {

class LensSubpathMutation final : public MeasuredMutation<LensSubpathMutation> {
 public:
  LensSubpathMutation(const PathTarget& target, Params&)
      : MeasuredMutation("lens_subpath", target) {}

  double suitability(const PathState& x) const override { return stop(x) > 0 ? 1 : 0; }

  std::optional<Edit> propose(const PathState& x, PathState& y,
                              MutationContext& context) const override {
    const Camera& camera = scene().camera();
    Rng& rng = context.rng;
    PositionSample lens = camera.sample_position({rng.next(), rng.next()}, x.path.time);
    lens.at.wavelength = x.path.wavelength;
    const Walker walker{scene(), x.path.time, context.rays};
    Ray ray = camera_ray(camera, lens.at, context.raster_position(camera.raster()));

    // The walk comes first, backwards: only then is the length of the path known.
    constexpr int most_vertices = 32;
    Spectrum likelihood(1);
    const int first = stop(x);
    std::vector<Vertex>& vertices = y.path.vertices;
    int count = 0;
    for (;; ++count) {
      if (count == most_vertices) return std::nullopt;
      vertices.resize(first + count + 1);
      Vertex& end = vertices.back();
      end = {};
      if (!walker.arrive(ray, walker.draw_leg(rng), end.at, likelihood)) return std::nullopt;
      const double stops = stop_probability(end.at);
      if (rng.next() < stops) break;
      const auto next = walker.scatter(end, -ray.d, {rng.next(), rng.next(), rng.next()});
      if (!next || (stops > 0 && !end.delta())) return std::nullopt;
      ray = *next;
    }
    const Edit edit{first, x.edges(), count + 2};
    if (x.edges() + edit.shift() > target().rules().most_edges()) return std::nullopt;
    splice(x, edit, y);
    const int k = y.edges();
    y.path[k] = camera_vertex(lens.at);
    std::reverse(vertices.begin() + first, vertices.end() - 1);
    target().evaluate(first, k, y);
    test_visibility(scene(), first, y, context.rays);
    return edit;
  }

  template <class Measure>
  double density_in(const Measure& in, const PathState& x, const PathState& y,
                    const Edit& edit) const {
    if (stop(x) != edit.first || stop(y) != edit.first) return 0;
    double p = in.joint(edit.first);
    for (int i = edit.first; i <= y.edges(); ++i) p *= from_camera(in, i);
    for (int i = edit.first; i < y.edges(); ++i) {
      const double stops = stop_probability(y[i].at);
      p *= i == edit.first ? stops : 1 - stops;
    }
    return p;
  }

 private:
  /// The vertex that ends the lens subpath: the first from the camera at which a walk may stop; -1
  /// if the one before it is not connectable.
  int stop(const PathState& x) const {
    int i = x.edges() - 1;
    while (i > 0 && (x[i].delta() || stop_probability(x[i].at) == 0)) --i;
    return i > 0 && !x[i - 1].delta() ? i : -1;
  }

  /// Probability with which a walk stops at this surface, to be joined there: 0 where all
  /// scattering is (nearly) specular, 1 where none is a delta.
  double stop_probability(const SurfacePoint& at) const {
    const BsdfAt bsdf(scene(), at);
    const Vec3& n = at.shading.n;
    if (!bsdf.has_smooth() || bsdf.smoother_than(target().near_specular(), n, n)) return 0;
    return bsdf.has_delta() ? 0.5 : 1.0;
  }
};

}  // namespace

MutationPlugin mutation_lens_subpath() {
  return {{"mutation",
           "lens_subpath",
           "lens subpath mutation, which draws a fresh camera end (Veach 1997, sec. 11.3.4).",
           {}},
          "lens_subpath_mutation",
          0.1,
          make_shared_mutation<LensSubpathMutation>};
}

}  // namespace mlt
