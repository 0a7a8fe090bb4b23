#include "mutation/bidirectional_mutation.h"

#include "mutation/mutation_registry.h"
#include "path/next_event.h"

namespace mlt {
namespace {

double power_of_half(int n) { return 1 / static_cast<double>(uint64_t{1} << std::min(n, 60)); }

/// May the gap lie between vertices l and m? What stays must scatter smoothly: a delta vertex would
/// only grow back what was there. An end of the path stays what it is.
bool deletable(const PathState& x, int l, int m) {
  const int k = x.edges();
  if ((l == -1 && m == 0) || (l == k && m == k + 1)) return false;
  return (l < 0 || x.terms[l].connectable) && (m > k || x.terms[m].connectable);
}

/// How many edges a gap has: mostly two, that is one vertex (Veach 1997, sec. 11.3.1.1). 1/4, 1/2 and
/// then 1/8, 1/16, ..., cut off at the k + 2 edges that a path of k edges has with its two open ends.
struct GapLength {
  static double probability(int edges, int k) {
    const double weight = edges == 1 ? 0.25 : edges == 2 ? 0.5 : power_of_half(edges);
    return weight / (1 - power_of_half(k + 2));
  }
  static int sample(double u, int k) {
    int edges = 1;
    while (edges < k + 2 && (u -= probability(edges, k)) >= 0) ++edges;
    return edges;
  }
};

/// Where a gap of this many edges may begin: l = -1 ... k + 1 - edges, whether deletable there or not.
int gap_positions(int edges, int k) { return k + 3 - edges; }

double deletion_probability(const PathState& x, int l, int m) {
  if (!deletable(x, l, m)) return 0;
  const int k = x.edges();
  return GapLength::probability(m - l, k) / gap_positions(m - l, k);
}

/// How many edges replace those of a gap: mostly as many (Veach 1997, sec. 11.3.1.2), but at least enough
/// for the ends that are missing.
struct AddedLength {
  static constexpr int most_change = 12;
  int least, most, deleted;

  AddedLength(int k, int l, int m, int most_edges) : deleted(m - l) {
    least = std::max(1 + (l < 0) + (m > k), deleted - most_change);
    most = std::min(deleted + most_change, most_edges - k + deleted);
  }
  double weight(int added) const {
    if (added == 1 && deleted == 1) return 0;  // one edge for one edge would change nothing
    const int change = std::abs(added - deleted);
    return change == 0 ? 0.5 : change == 1 ? 0.15 : 0.2 * power_of_half(change);
  }
  double total() const {
    double sum = 0;
    for (int c = least; c <= most; ++c) sum += weight(c);
    return sum;
  }
  double probability(int added) const {
    return added < least || added > most ? 0.0 : weight(added) / total();
  }
  /// 0 if nothing may be added.
  int sample(double u) const {
    u *= total();
    int added = least;
    while (added < most && (u -= weight(added)) >= 0) ++added;
    return added <= most && weight(added) > 0 ? added : 0;
  }
};

/// How many of n inserted vertices may come from the light: not all, where the last one would have to
/// hit a lens that is a point.
int most_from_light(int n, bool lens_is_missing, const Scene& scene) {
  return lens_is_missing && scene.camera().delta_position() ? n - 1 : n;
}

}  // namespace

std::optional<Edit> BidirectionalMutation::propose(const PathState& x, PathState& y,
                                                   MutationContext& context) const {
  const int k = x.edges();
  const int gap = GapLength::sample(context.rng.next(), k);
  const int l = static_cast<int>(context.rng.below(gap_positions(gap, k))) - 1, m = l + gap;
  if (!deletable(x, l, m)) return std::nullopt;
  const int added = AddedLength(k, l, m, most_edges()).sample(context.rng.next());
  if (added == 0) return std::nullopt;

  const int n = added - 1;
  const Edit edit{l + 1, m - 1, n};
  const int s = static_cast<int>(context.rng.below(most_from_light(n, m > k, *scene_) + 1)),
            t = n - s;
  splice(x, edit, y);
  if (l < 0 && m > k) y.path.time = scene_->camera().time(context.rng.next());
  // The emitter chosen to be seen from x_1 needs x_1: the camera side grows first.
  if (!grow_from_camera(y, edit.first + s, t, context)) return std::nullopt;
  if (!grow_from_light(y, edit.first, s, context)) return std::nullopt;
  target_->evaluate(edit.first, edit.first + n - 1, y);
  if (!(y.target > 0)) return edit;
  const int joint = edit.first + s;  // the connecting edge is (joint - 1, joint)
  if (joint > 0 && joint <= y.edges()) {
    ++context.rays.occluded;
    if (!scene_->visible(y[joint - 1].at, y[joint].at, y.path.time)) y.target = 0;
  }
  return edit;
}

/// Fills vertices first ... first + count - 1 by a walk from vertex first - 1, or from a light.
bool BidirectionalMutation::grow_from_light(PathState& y, int first, int count,
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
    } else if (!scatter(from, direction(from.at, path[i - 2].at), i == first, path.time, context,
                        ray)) {
      return false;
    }
    if (i < path.edges() ? !arrive(ray, path[i], context) : !arrive_at_lens(ray, path[i], context))
      return false;
  }
  return true;
}

/// Fills vertices first ... first + count - 1, the last one first, by a walk from vertex first + count,
/// or from the lens.
bool BidirectionalMutation::grow_from_camera(PathState& y, int first, int count,
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
    if (i > 0 ? !arrive(ray, path[i], context) : !arrive_at_light(ray, path[0], context))
      return false;
  }
  return true;
}

/// Samples a direction at a surface vertex. One that stays (`kept`) must go on scattering smoothly.
bool BidirectionalMutation::scatter(Vertex& from, const Vec3& towards_previous, bool kept,
                                    double time, MutationContext& context, Ray& ray) const {
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

/// The lens does not stop a ray, but what stands before it does.
bool BidirectionalMutation::arrive_at_lens(const Ray& ray, Vertex& xk,
                                           MutationContext& context) const {
  const auto lens = scene_->camera().hit_lens(ray);
  if (!lens) return false;
  xk = camera_vertex(*lens);
  SurfacePoint at;
  ++context.rays.intersect;
  return !scene_->intersect(ray, at) ||
         length_squared(at.p - ray.o) > length_squared(lens->p - ray.o);
}

bool BidirectionalMutation::arrive_at_light(const Ray& ray, Vertex& x0,
                                            MutationContext& context) const {
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

double BidirectionalMutation::density(const PathState& x, const PathState& y,
                                      const Edit& edit) const {
  const int k = x.edges(), l = edit.first - 1, m = edit.last + 1, n = edit.inserted;
  const double p_delete = deletion_probability(x, l, m);
  if (p_delete == 0) return 0;
  const double p_length = AddedLength(k, l, m, most_edges()).probability(n + 1);
  const int most = most_from_light(n, m > k, *scene_);
  double sum = 0;
  for (int s = 0; s <= most; ++s) {
    const int technique = edit.first + s;
    if (!can_sample(y.terms, technique)) continue;
    double p = 1;
    if (technique == 0 && y[0].at.infinite())
      p /= static_cast<double>(scene_->backgrounds().size());
    for (int i = edit.first; i < edit.first + n; ++i) {
      if (i >= technique)
        p *= y.terms[i].from_camera;
      else
        p *= i == 0 && technique == 1 ? y.terms.direct : y.terms[i].from_light;
    }
    sum += p;
  }
  return p_delete * p_length * sum / (most + 1);
}

MutationPlugin mutation_bidirectional() {
  return {
      {"mutation",
       "bidirectional",
       "bidirectional mutation, which replaces any piece of the path (Veach 1997, sec. 11.3.1).",
       {}},
      "bidirectional_mutation",
      0.3,
      [](const PathTarget& target, Params&) -> MutationPtr {
        return std::make_shared<BidirectionalMutation>(target);
      }};
}

}  // namespace mlt
