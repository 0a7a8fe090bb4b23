#include "mutation/evaluate_proposal.h"

#include "path/walk.h"

namespace mlt {
namespace {

bool same(const Vertex& a, const Vertex& b) {
  return a.kind == b.kind && a.lobe == b.lobe && a.emitter == b.emitter && a.at.kind == b.at.kind &&
         a.at.p == b.at.p && a.at.shape == b.at.shape && a.at.primitive == b.at.primitive;
}

/// How far, as a sine, the directions at vertex i may be from those that a delta prescribes. Rays
/// start a little off a surface, so that the directions between the vertices that they connect
/// are not those of the rays; the less so, the shorter the edge.
double delta_tolerance(const Scene& scene, const Path& path, int i) {
  const double near = 1e-2 * scene.bounds().radius;
  double shortest = near;
  for (const int j : {i - 1, i + 1})
    if (j >= 0 && !path[j].at.infinite())
      shortest = std::min(shortest, length(path[j].at.p - path[i].at.p));
  return 1e-3 * near / shortest;
}

/// Whether delta vertex i scatters light from one of its neighbours to the other, or, as a light,
/// emits it to x_1.
bool obeys_delta(const Scene& scene, const Path& path, int i) {
  const Vertex& x = path[i];
  if (i == 0) {
    const Vec3 w = scene.emitters()[x.emitter]->sample_ray(x.at, Vec2(0.5)).direction;
    return length(direction(x.at, path[1].at) - w) < delta_tolerance(scene, path, 0);
  }
  const Bsdf& bsdf = scene.bsdf(x.at);
  const Vec3 from = x.at.shading.to_local(direction(x.at, path[i - 1].at));
  const Vec3 to = x.at.shading.to_local(direction(x.at, path[i + 1].at));
  const auto u = bsdf.invert(x.at, from, to, x.lobe, Vec3(0.5));
  if (!u) return false;
  const auto sample = bsdf.sample(x.at, from, *u);
  return sample && sample->lobe == x.lobe &&
         length(sample->to - to) < delta_tolerance(scene, path, i);
}

}  // namespace

Edit difference(const Path& x, const Path& y) {
  if (x.time != y.time || x.wavelength != y.wavelength) return {0, x.edges(), y.edges() + 1};
  const int shorter = static_cast<int>(std::min(x.vertices.size(), y.vertices.size()));
  int first = 0;
  while (first < shorter && same(x[first], y[first])) ++first;
  int kept = 0;  // at the camera's end
  while (first + kept < shorter && same(x[x.edges() - kept], y[y.edges() - kept])) ++kept;
  return {first, x.edges() - kept, y.edges() + 1 - kept - first};
}

bool passable(const Scene& scene, const Path& path, int first, int last, RayCounts& rays) {
  const int k = path.edges();
  const Walker walker{scene, path.time, rays};
  for (int i = std::max(0, first - 1); i <= std::min(k - 1, last + 1); ++i)
    if (path[i].delta() && !obeys_delta(scene, path, i)) return false;
  for (int i = std::max(0, first - 1); i <= std::min(k - 1, last); ++i) {
    if (path[i].at.infinite() && path[i + 1].at.infinite()) return false;
    if (!walker.sees(path[i].at, path[i + 1].at)) return false;
  }
  return true;
}

Edit evaluate_proposal(const PathTarget& target, const PathState& x, PathState& y,
                       RayCounts& rays) {
  const Edit edit = difference(x.path, y.path);
  target.evaluate(y);
  const int last = edit.first + edit.inserted - 1;
  if (y.target > 0 && !passable(target.scene(), y.path, edit.first, last, rays)) y.target = 0;
  return edit;
}

PathState evaluated(const PathTarget& target, const Path& path, RayCounts& rays) {
  PathState x;
  x.path = path;
  target.evaluate(x);
  if (x.target > 0 && !passable(target.scene(), path, 0, path.edges(), rays)) x.target = 0;
  return x;
}

}  // namespace mlt
