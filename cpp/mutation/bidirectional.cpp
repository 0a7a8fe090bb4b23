// The bidirectional mutation (Veach & Guibas 1997, sec. 5.3.1; Veach 1997, sec. 11.3.1): delete a
// piece of the path, grow new vertices from both ends of the gap, and connect them. It can change
// anything, including the length, so it makes the chain ergodic on its own.
//
// With x_l and x_m the vertices that stay on both sides of the gap (l = -1 or m = k + 1: no vertex
// stays there), c_d = m - l edges are deleted and c_a = s + t + 1 are added, of which s vertices
// come from the light side and t from the camera side. All ways (s, t) of making the same vertices
// are summed:
//
//   q(x -> y) = p_delete(l, m | x) p_length(c_a | c_d) sum_s p_way(s) p_s(inserted vertices)
//
// Divided by |f| of the inserted part, p_s is 1 / C_s, with the unweighted contribution C_s of one
// connection.
#include "mutation/edge_visibility.h"
#include "mutation/measured_mutation.h"
#include "mutation/mutation_registry.h"

#include <array>

namespace mlt {
namespace {

double power_of_half(int n) { return 1 / static_cast<double>(uint64_t{1} << std::min(n, 60)); }

/// Whether the gap may lie between vertices l and m. They must scatter smoothly: a delta vertex
/// would only sample the deleted vertices again. An end of the path stays unchanged.
bool deletable(const PathState& x, int l, int m) {
  const int k = x.edges();
  if ((l == -1 && m == 0) || (l == k && m == k + 1)) return false;
  return (l < 0 || x.terms[l].connectable) && (m > k || x.terms[m].connectable);
}

/// The number of edges of a gap: mostly two, that is one vertex (Veach 1997, sec. 11.3.1.1). Its
/// probabilities are 1/4, 1/2 and then 1/8, 1/16, ..., cut off at the k + 2 edges that a path of k
/// edges has with its two open ends.
struct GapLength {
  static double weight(int edges) {
    return edges == 1 ? 0.25 : edges == 2 ? 0.5 : power_of_half(edges);
  }
  static double total(int k) { return 1 - power_of_half(k + 2); }
  static double probability(int edges, int k) { return weight(edges) / total(k); }
  static int sample(double u, int k) {
    u *= total(k);
    int edges = 1;
    while (edges < k + 2 && (u -= weight(edges)) >= 0) ++edges;
    return edges;
  }
};

/// Number of places where a gap of this many edges may begin: l = -1 ... k + 1 - edges, whether
/// deletable there or not.
int gap_positions(int edges, int k) { return k + 3 - edges; }

double deletion_probability(const PathState& x, int l, int m) {
  if (!deletable(x, l, m)) return 0;
  const int k = x.edges();
  return GapLength::probability(m - l, k) / gap_positions(m - l, k);
}

/// The number of edges that replace those of a gap: mostly as many (Veach 1997, sec. 11.3.1.2), but
/// at least enough for the ends that are missing.
struct AddedLength {
  static constexpr int most_change = 12;
  int least, most, deleted;
  double total = 0;  ///< Sum of the weights from least to most.

  AddedLength(int k, int l, int m, int most_edges) : deleted(m - l) {
    least = std::max(1 + (l < 0) + (m > k), deleted - most_change);
    most = std::min(deleted + most_change, most_edges - k + deleted);
    if (least > most) return;
    total = sums()[most - deleted + most_change] - sums()[least - deleted + most_change] +
            weight_of_change(least - deleted);
    if (deleted == 1 && least == 1) total -= weight_of_change(0);
  }
  static double weight_of_change(int change) {
    change = std::abs(change);
    return change == 0 ? 0.5 : change == 1 ? 0.15 : 0.2 * power_of_half(change);
  }
  /// Partial sums of the weights of all changes from -most_change on.
  static const std::array<double, 2 * most_change + 1>& sums() {
    static const auto sums = [] {
      std::array<double, 2 * most_change + 1> sums;
      double sum = 0;
      for (int i = 0; i <= 2 * most_change; ++i) sums[i] = sum += weight_of_change(i - most_change);
      return sums;
    }();
    return sums;
  }
  double weight(int added) const {
    if (added == 1 && deleted == 1) return 0;  // one edge for one edge would change nothing
    return weight_of_change(added - deleted);
  }
  double probability(int added) const {
    return added < least || added > most ? 0.0 : weight(added) / total;
  }
  /// Samples the number of edges; 0 if none may be added.
  int sample(double u) const {
    u *= total;
    int added = least;
    while (added < most && (u -= weight(added)) >= 0) ++added;
    return added <= most && weight(added) > 0 ? added : 0;
  }
};

/// The largest number of n inserted vertices that may come from the light: not all, where the last
/// one would have to hit a lens that no walk can hit.
int most_from_light(int n, bool lens_is_missing, const Scene& scene) {
  return lens_is_missing && !scene.camera().can_be_hit() ? n - 1 : n;
}

/// Samples the vertex where a walk begins: on the lens, or on a light. If no other vertex is
/// inserted on the light side, the light is sampled for x_1.
bool new_end(const Scene& scene, Path& path, int i, bool alone, Rng& rng) {
  if (i > 0) {
    path[i] = camera_vertex(scene.camera().sample_position({rng.next(), rng.next()}, path.time).at);
    path[i].at.wavelength = path.wavelength;
    return true;
  }
  const Vec3 u{rng.next(), rng.next(), rng.next()};
  const LightSample light = alone ? sample_direct_position(scene, path[1].at, u)
                                  : sample_light_position(scene, u, path.time, path.wavelength);
  if (!(light.x0.pdf > 0)) return false;
  path[0] = light_vertex(*light.emitter, light.x0.at);
  return true;
}

std::optional<Ray> leave_end(const Walker& walker, const Vertex& end, Rng& rng) {
  const Vec2 u{rng.next(), rng.next()};
  const Camera& camera = walker.scene.camera();
  if (end.kind == VertexKind::camera) return camera_ray(camera, end.at, camera.raster().sample(u));
  const Departure first = walker.emitted_ray(end, u);
  if (!(first.pdf > 0)) return std::nullopt;
  return first.ray;
}

/// Follows a leg with this likelihood to vertex i: on a surface, in a medium, on a light at
/// infinity, or on the lens.
bool arrive(const Walker& walker, const Ray& ray, Spectrum& likelihood, Path& path, int i,
            Rng& rng) {
  if (i == path.edges()) return walker.arrive_at_lens(ray, path[i]);
  const double u_leg = walker.draw_leg(rng);
  path[i] = {};
  if (i > 0) return walker.arrive(ray, u_leg, path[i].at, likelihood);
  const auto any_background = [&]() -> const Emitter* {
    const std::vector<uint32_t>& indices = walker.scene.backgrounds();
    if (indices.empty()) return nullptr;
    return walker.scene.emitters()[indices[rng.below(indices.size())]].get();
  };
  return walker.arrive_at_light(ray, u_leg, likelihood, any_background, path[0]);
}

class BidirectionalMutation final : public MeasuredMutation<BidirectionalMutation> {
 public:
  BidirectionalMutation(const PathTarget& target, Params&)
      : MeasuredMutation("bidirectional", target) {}

  double suitability(const PathState&) const override { return 1; }
  bool ergodic() const override { return true; }

  std::optional<Edit> propose(const PathState& x, PathState& y,
                              MutationContext& context) const override {
    const int k = x.edges();
    const int gap = GapLength::sample(context.rng.next(), k);
    const int l = static_cast<int>(context.rng.below(gap_positions(gap, k))) - 1, m = l + gap;
    if (!deletable(x, l, m)) return std::nullopt;
    const int added = AddedLength(k, l, m, most_edges()).sample(context.rng.next());
    if (added == 0) return std::nullopt;

    const int n = added - 1;
    const Edit edit{l + 1, m - 1, n};
    const int s = static_cast<int>(context.rng.below(most_from_light(n, m > k, scene()) + 1)),
              t = n - s;
    splice(x, edit, y);
    if (l < 0 && m > k) {
      const Camera& camera = scene().camera();
      y.path.time = camera.time(context.rng.next());
      y.path.wavelength = camera.wavelength([&] { return context.rng.next(); });
    }
    // Sampling an emitter for x_1 needs x_1, so the camera side grows first.
    if (!grow(y, edit.first + n - 1, t, -1, context)) return std::nullopt;
    if (!grow(y, edit.first, s, 1, context)) return std::nullopt;
    target().evaluate(edit.first, edit.first + n - 1, y);
    const int joint = edit.first + s;
    if (joint > 0 && joint <= y.edges()) test_visibility(scene(), joint, y, context.rays);
    return edit;
  }

  template <class Measure>
  double density_in(const Measure& in, const PathState& x, const PathState& y,
                    const Edit& edit) const {
    const int k = x.edges(), l = edit.first - 1, m = edit.last + 1, n = edit.inserted;
    const double p_delete = deletion_probability(x, l, m);
    if (p_delete == 0) return 0;
    const double p_length = AddedLength(k, l, m, most_edges()).probability(n + 1);
    const auto backgrounds = static_cast<double>(scene().backgrounds().size());
    const double hit_light = y[0].at.infinite() && backgrounds > 0 ? 1 / backgrounds : 1.0;
    return p_delete * p_length * total_density(in, edit.first, edit.first + n, hit_light) /
           (most_from_light(n, m > k, scene()) + 1);
  }

 private:
  /// Fills `count` vertices from number `first` on, in steps of +1 by a walk from the light or of
  /// -1 by one from the camera. The walk continues from the vertex before, or begins if there is
  /// none.
  bool grow(PathState& y, int first, int count, int step, MutationContext& context) const {
    Path& path = y.path;
    Rng& rng = context.rng;
    const Walker walker{scene(), path.time, context.rays};
    const int begin = step > 0 ? 0 : path.edges();
    Spectrum likelihood = y.terms.likelihood(first - step, step);
    for (int i = first; i != first + count * step; i += step) {
      if (i == begin) {
        if (!new_end(scene(), path, i, count == 1, rng)) return false;
        continue;
      }
      Vertex& from = path[i - step];
      std::optional<Ray> ray;
      if (i - step == begin) {
        ray = leave_end(walker, from, rng);
      } else {
        const Vec3 u{rng.next(), rng.next(), rng.next()};
        ray = walker.scatter(from, direction(from.at, path[i - 2 * step].at), u);
        if (i == first && from.delta()) return false;  // it must go on scattering smoothly
      }
      if (!ray || !arrive(walker, *ray, likelihood, path, i, rng)) return false;
    }
    return true;
  }

  int most_edges() const { return target().rules().most_edges(); }
};

}  // namespace

MutationPlugin mutation_bidirectional() {
  return {
      {"mutation",
       "bidirectional",
       "bidirectional mutation, which replaces any piece of the path (Veach 1997, sec. 11.3.1).",
       {}},
      "bidirectional_mutation",
      0.3,
      make_shared_mutation<BidirectionalMutation>};
}

}  // namespace mlt
