#include "mutation/bidirectional.h"

#include "path/next_event.h"

namespace mlt {
namespace {

double power_of_half(int n) { return 1 / static_cast<double>(uint64_t{1} << std::min(n, 60)); }

/// Weight of deleting `edges` edges (Veach 1997, sec. 11.3.1.1): mostly two, that is one vertex.
double deletion_weight(int edges) {
  if (edges <= 1) return 0.25;
  return edges == 2 ? 0.5 : power_of_half(edges);
}

/// Weight of adding `added` edges where `deleted` were (Veach 1997, sec. 11.3.1.2).
double addition_weight(int added, int deleted) {
  const int change = std::abs(added - deleted);
  if (change == 0) return 0.5;
  return change == 1 ? 0.15 : 0.2 * power_of_half(change);
}

/// May the gap lie between vertices l and m? What stays must scatter smoothly: a delta vertex would
/// only grow back what was there. An end of the path stays what it is.
bool deletable(const LightPath& x, int l, int m) {
  const int k = x.edges();
  if ((l == -1 && m == 0) || (l == k && m == k + 1)) return false;
  return (l < 0 || x.terms.connectable[l]) && (m > k || x.terms.connectable[m]);
}

template <class Visit>
void for_each_gap(const LightPath& x, Visit&& visit) {
  const int k = x.edges();
  for (int l = -1; l <= k; ++l)
    for (int m = l + 1; m <= k + 1; ++m)
      if (deletable(x, l, m)) visit(l, m, deletion_weight(m - l));
}

double deletion_probability(const LightPath& x, int l, int m) {
  if (!deletable(x, l, m)) return 0;
  double sum = 0;
  for_each_gap(x, [&](int, int, double weight) { sum += weight; });
  return deletion_weight(m - l) / sum;
}

/// How many edges may replace those of a gap: at least enough for the ends that are missing.
struct Lengths {
  int least, most, deleted;

  Lengths(int edges, int l, int m, int most_edges) : deleted(m - l) {
    least = 1 + (l < 0) + (m > edges);
    most = std::min(deleted + most_change, most_edges - edges + deleted);
  }
  /// One edge for one edge would change nothing.
  double weight(int added) const {
    if (added < least || added > most || (added == 1 && deleted == 1)) return 0;
    return addition_weight(added, deleted);
  }
  double probability(int added) const {
    double sum = 0;
    for (int c = least; c <= most; ++c) sum += weight(c);
    return sum > 0 ? weight(added) / sum : 0.0;
  }
  static constexpr int most_change = 12;
};

/// How many of n inserted vertices may come from the light: not all, where the last one would have to
/// hit a lens that is a point.
int most_from_light(int n, bool lens_is_missing, const Scene& scene) {
  return lens_is_missing && scene.camera().delta_position() ? n - 1 : n;
}

}  // namespace

const std::string& BidirectionalMutation::name() const {
  static const std::string name = "bidirectional";
  return name;
}

std::optional<Edit> BidirectionalMutation::propose(const LightPath& x, LightPath& y,
                                                   MutationContext& context) const {
  const int k = x.edges();
  int l = -1, m = k + 1;
  double sum = 0;
  for_each_gap(x, [&](int, int, double weight) { sum += weight; });
  double u = context.rng.next() * sum;
  bool chosen = false;
  for_each_gap(x, [&](int first, int last, double weight) {
    if (chosen) return;
    l = first;
    m = last;
    chosen = (u -= weight) < 0;
  });

  const Lengths lengths(k, l, m, most_edges());
  double total = 0;
  for (int c = lengths.least; c <= lengths.most; ++c) total += lengths.weight(c);
  if (!(total > 0)) return std::nullopt;
  u = context.rng.next() * total;
  int added = lengths.least;
  while (added < lengths.most && (u -= lengths.weight(added)) >= 0) ++added;
  if (lengths.weight(added) == 0) return std::nullopt;

  const int n = added - 1;
  const Edit edit{l + 1, m - 1, n};
  const int s = static_cast<int>(context.rng.below(most_from_light(n, m > k, *scene_) + 1)), t = n - s;
  splice(x, edit, y);
  if (l < 0 && m > k) y.path.time = scene_->camera().time(context.rng.next());
  // The emitter chosen to be seen from x_1 needs x_1: the camera side grows first.
  if (!grow_from_camera(y, edit.first + s, t, context)) return std::nullopt;
  if (!grow_from_light(y, edit.first, s, context)) return std::nullopt;
  evaluate(*scene_, settings_, edit.first, edit.first + n - 1, y);
  if (!(y.target > 0)) return edit;
  const int joint = edit.first + s;  // the connecting edge is (joint - 1, joint)
  if (joint > 0 && joint <= y.edges()) {
    ++context.rays.occluded;
    if (!scene_->visible(y[joint - 1].at, y[joint].at, y.path.time)) y.target = 0;
  }
  return edit;
}

/// Fills vertices first ... first + count - 1 by a walk from vertex first - 1, or from a light.
bool BidirectionalMutation::grow_from_light(LightPath& y, int first, int count,
                                            MutationContext& context) const {
  Path& path = y.path;
  Rng& rng = context.rng;
  for (int i = first; i < first + count; ++i) {
    if (i == 0) {
      const Vec3 u{rng.next(), rng.next(), rng.next()};
      if (count == 1) {
        const EmitterSample light = sample_emitter(*scene_, path[1].at.p, u);
        if (!(light.pdf > 0)) return false;
        path[0] = light_vertex(*light.emitter, light.x0);
        continue;
      }
      double u_choice = u.x;
      const EmitterChoice choice = scene_->choose_emitter(u_choice);
      const PositionSample position = choice.emitter->sample_position({u.y, u.z});
      if (!(position.pdf > 0)) return false;
      path[0] = light_vertex(*choice.emitter, position.at);
      continue;
    }
    Ray ray;
    Vertex& from = path[i - 1];
    if (i == 1) {
      const RaySample sample =
          scene_->emitters()[from.emitter]->sample_ray(from.at, {rng.next(), rng.next()});
      if (!(sample.pdf > 0)) return false;
      ray = from.at.infinite() ? Ray{sample.origin, sample.direction, path.time}
                               : scene_->spawn(from.at, sample.direction, path.time);
    } else if (!scatter(from, direction(from.at, path[i - 2].at), i == first, path.time, context, ray)) {
      return false;
    }
    if (!arrive(ray, path[i], context)) return false;
  }
  return true;
}

/// Fills vertices first ... first + count - 1, the last one first, by a walk from vertex first + count,
/// or from the lens.
bool BidirectionalMutation::grow_from_camera(LightPath& y, int first, int count,
                                             MutationContext& context) const {
  Path& path = y.path;
  Rng& rng = context.rng;
  const int k = path.edges();
  for (int i = first + count - 1; i >= first; --i) {
    if (i == k) {
      const PositionSample lens = scene_->camera().sample_position({rng.next(), rng.next()});
      path[k] = camera_vertex(lens.at);
      continue;
    }
    Ray ray;
    Vertex& from = path[i + 1];
    if (i == k - 1) {
      const Vec2 raster = scene_->camera().raster().sample({rng.next(), rng.next()});
      ray = {from.at.p, scene_->camera().direction(from.at, raster), path.time};
    } else if (!scatter(from, direction(from.at, path[i + 2].at), i == first + count - 1, path.time,
                        context, ray)) {
      return false;
    }
    if (i > 0 ? !arrive(ray, path[i], context) : !arrive_at_light(ray, path[0], context)) return false;
  }
  return true;
}

/// Samples a direction at a surface vertex. One that stays (`kept`) must go on scattering smoothly.
bool BidirectionalMutation::scatter(Vertex& from, const Vec3& towards_previous, bool kept, double time,
                                    MutationContext& context, Ray& ray) const {
  const SurfacePoint& at = from.at;
  Rng& rng = context.rng;
  const Vec3 u{rng.next(), rng.next(), rng.next()};
  const auto sample = scene_->bsdf(at).sample(at, at.shading.to_local(towards_previous), u);
  if (!sample || (kept && sample->lobe != Lobe::smooth)) return false;
  from.lobe = sample->lobe;
  ray = scene_->spawn(at, at.shading.to_world(sample->to), time);
  return true;
}

bool BidirectionalMutation::arrive(const Ray& ray, Vertex& next, MutationContext& context) const {
  SurfacePoint at;
  ++context.rays.intersect;
  if (!scene_->intersect(ray, at)) return false;
  next = surface_vertex(at);
  return true;
}

bool BidirectionalMutation::arrive_at_light(const Ray& ray, Vertex& x0, MutationContext& context) const {
  SurfacePoint at;
  ++context.rays.intersect;
  if (scene_->intersect(ray, at)) {
    const Emitter* emitter = scene_->emitter(at);
    if (!emitter) return false;
    x0 = light_vertex(*emitter, at);
    return true;
  }
  const std::vector<uint32_t>& backgrounds = scene_->backgrounds();
  if (backgrounds.empty()) return false;
  const uint32_t index = backgrounds[context.rng.below(backgrounds.size())];
  x0 = light_vertex(*scene_->emitters()[index], Scene::point_at_infinity(ray.d));
  return true;
}

double BidirectionalMutation::density(const LightPath& x, const LightPath& y, const Edit& edit) const {
  const int k = x.edges(), l = edit.first - 1, m = edit.last + 1, n = edit.inserted;
  const double p_delete = deletion_probability(x, l, m);
  if (p_delete == 0) return 0;
  const double p_length = Lengths(k, l, m, most_edges()).probability(n + 1);
  const int most = most_from_light(n, m > k, *scene_);
  double sum = 0;
  for (int s = 0; s <= most; ++s) {
    const int technique = edit.first + s;
    if (!can_sample(y.terms, technique)) continue;
    double p = 1;
    if (technique == 0 && y[0].at.infinite()) p /= static_cast<double>(scene_->backgrounds().size());
    for (int i = edit.first; i < edit.first + n; ++i) {
      if (i >= technique)
        p *= y.terms.from_camera[i];
      else
        p *= i == 0 && technique == 1 ? y.terms.direct : y.terms.from_light[i];
    }
    sum += p;
  }
  return p_delete * p_length * sum / (most + 1);
}

}  // namespace mlt
