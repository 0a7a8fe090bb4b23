#include "mutation/lens_subpath.h"

#include "mutation/join.h"
#include "mutation/mutation_registry.h"

namespace mlt {

int LensSubpathMutation::stop(const PathState& x) const {
  int i = x.edges() - 1;
  while (i > 0 && (x[i].delta() || stop_probability(x[i].at) == 0)) --i;
  return i > 0 && !x[i - 1].delta() ? i : -1;
}

double LensSubpathMutation::stop_probability(const SurfacePoint& at) const {
  const Bsdf& bsdf = scene_->bsdf(at);
  const Vec3 up(0, 0, 1);
  if (!bsdf.has_smooth() || bsdf.roughness(at, up, up) < target_->near_specular()) return 0;
  return bsdf.has_delta() ? 0.5 : 1.0;
}

std::optional<Edit> LensSubpathMutation::propose(const PathState& x, PathState& y,
                                                 MutationContext& context) const {
  const Camera& camera = scene_->camera();
  Rng& rng = context.rng;
  const PositionSample lens = camera.sample_position({rng.next(), rng.next()});
  const Walker walker{*scene_, x.path.time, context.rays};
  Ray ray = leave_lens(camera, lens.at, context.raster_position(camera.raster()), x.path.time);

  // The walk comes first: only then is the length of the path known.
  constexpr int most_vertices = 32;
  Vertex walk[most_vertices];
  int count = 0;
  for (;; ++count) {
    if (count == most_vertices || !walker.arrive(ray, walk[count])) return std::nullopt;
    Vertex& end = walk[count];
    const double stops = stop_probability(end.at);
    if (rng.next() < stops) break;
    const auto next = walker.scatter(end, -ray.d, {rng.next(), rng.next(), rng.next()});
    if (!next || (stops > 0 && !end.delta())) return std::nullopt;
    ray = *next;
  }
  const int first = stop(x);
  const Edit edit{first, x.edges(), count + 2};
  if (x.edges() + edit.shift() > target_->rules().most_edges()) return std::nullopt;
  splice(x, edit, y);
  const int k = y.edges();
  y.path[k] = camera_vertex(lens.at);
  for (int i = 0; i <= count; ++i) y.path[k - 1 - i] = walk[i];
  target_->evaluate(first, k, y);
  join(*scene_, first, y, context.rays);
  return edit;
}

double LensSubpathMutation::density(const PathState& x, const PathState& y,
                                    const Edit& edit) const {
  if (stop(x) != edit.first || stop(y) != edit.first) return 0;
  double p = 1;
  for (int i = edit.first; i <= y.edges(); ++i) p *= y.terms[i].from_camera;
  for (int i = edit.first; i < y.edges(); ++i) {
    const double stops = stop_probability(y[i].at);
    p *= i == edit.first ? stops : 1 - stops;
  }
  return p;
}

MutationPlugin mutation_lens_subpath() {
  return {{"mutation",
           "lens_subpath",
           "lens subpath mutation, which draws a fresh camera end (Veach 1997, sec. 11.3.4).",
           {}},
          "lens_subpath_mutation",
          0.1,
          [](const PathTarget& target, Params&) -> MutationPtr {
            return std::make_shared<LensSubpathMutation>(target);
          }};
}

}  // namespace mlt
