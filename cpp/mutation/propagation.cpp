// The propagation mutation (Pauly, Kollig & Keller 2000, "Metropolis light transport for
// participating media", sec. 4.2): a vertex in a medium moves along one of its two edges, and is
// joined to its other neighbour anew. So it explores what the perturbations of directions keep:
// distances in media.
//
// The distance d becomes d e^xi, with the density g(xi) of a symmetric distribution. By volume the
// new vertex has the density g(xi) / d'^3, times that of its direction, which stays: so
//
//   q(y -> x) / q(x -> y) = (d' / d)^3,
//
// of which (d / d')^2 is in G of the edge. Where the other neighbour on the light side is specular,
// the chain from there on is found again by a manifold walk.
#include "mutation/chain_perturbation.h"
#include "mutation/manifold_chain.h"
#include "mutation/measured_mutation.h"
#include "mutation/mutation_registry.h"

namespace mlt {
namespace {

/// Vertex b moves along the edge from vertex b - step, and is joined to vertex b + step or, across
/// a specular chain on the light side, to c.
struct Propagation {
  int b = -1, step = -1, c = -1;

  int start() const { return b - step; }
  bool is_direct() const { return c == b + step; }
  ManifoldChain chain() const { return {c, b}; }

  int first_moved() const { return std::min(b, c + 1); }
  Edit moved() const { return {first_moved(), b, b - first_moved() + 1}; }
  /// An edit from which it can be read again: with the edge's start on the camera side, that is
  /// replaced by itself.
  Edit edit() const {
    const Edit edit = moved();
    return step > 0 ? edit : Edit{edit.first, b + 1, edit.inserted + 1};
  }
};

class PropagationMutation final : public MeasuredMutation<PropagationMutation> {
 public:
  PropagationMutation(const PathTarget& target, Params& params)
      : MeasuredMutation("propagation", target),
        move_(params.real_in("smallest_move", 1e-9, 1), params.real_in("largest_move", 1e-6, 10)) {
    if (!(move_.log_ratio > 0)) params.fail("largest_move", "is not above smallest_move");
  }

  double suitability(const PathState& x) const override { return count(x) > 0 ? 1 : 0; }

  std::optional<Edit> propose(const PathState& x, PathState& y,
                              MutationContext& context) const override {
    const Propagation p = number(x, static_cast<int>(context.rng.below(count(x))));
    splice(x, p.moved(), y);
    if (!move(x, p, y, context)) return std::nullopt;
    if (!p.is_direct() && !p.chain().find(scene(), x, y, context)) return std::nullopt;
    target().evaluate(p.first_moved(), p.b, y);
    if (y.target > 0 && !p.is_direct() &&
        !(same_form(x, y, p) && p.chain().leads_back(scene(), x, y, context)))
      return std::nullopt;
    return p.edit();
  }

  template <class Measure>
  double density_in(const Measure& in, const PathState& x, const PathState& y,
                    const Edit& edit) const {
    const Propagation p = propagation_of(x, edit);
    if (p.b < 0 || propagation_of(y, edit).b < 0 || !same_form(x, y, p)) return 0;
    const double moved = distance(y, p),
                 along = move_.linear_pdf(std::fabs(std::log(moved / distance(x, p)))) / moved;
    const double joined =
        p.is_direct() ? in.joint(p.step < 0 ? p.b : p.b + 1) : p.chain().density(in, scene(), y);
    return along * in.step(p.start(), p.b) * joined * kept(in, p) / count(x);
  }

 private:
  /// The propagation of this vertex along this edge; b < 0 if there is none.
  Propagation propagation(const PathState& x, int b, int step) const {
    if (!x[b].at.in_medium() || x[b - step].at.infinite()) return {};
    if (x.terms[b + step].connectable) return {b, step, b + step};
    if (step > 0) return {};
    const Propagation across{b, step, ChainPerturbation::chain_end(x, b, step)};
    return across.chain().can_be_walked(scene(), x) ? across : Propagation{};
  }
  Propagation propagation_of(const PathState& x, const Edit& edit) const {
    const bool towards_camera = edit.deleted() == 1;
    const Propagation p =
        towards_camera ? propagation(x, edit.first, 1) : propagation(x, edit.last - 1, -1);
    return p.edit().first == edit.first ? p : Propagation{};
  }

  template <class See>
  void for_each(const PathState& x, See&& see) const {
    for (int b = 1; b < x.edges(); ++b)
      for (const int step : {-1, 1})
        if (const Propagation p = propagation(x, b, step); p.b > 0) see(p);
  }
  int count(const PathState& x) const {
    return x.known.propagations.get([&] {
      int count = 0;
      for_each(x, [&](const Propagation&) { ++count; });
      return count;
    });
  }
  Propagation number(const PathState& x, int number) const {
    Propagation found;
    for_each(x, [&](const Propagation& p) {
      if (number-- == 0) found = p;
    });
    return found;
  }

  /// The distance that is flown in media along the edge up to b.
  double distance(const PathState& x, const Propagation& p) const {
    return length(x[p.b].at.p - edge_start(x, p));
  }
  Vec3 edge_start(const PathState& x, const Propagation& p) const {
    return scene().edge_end(x[p.start()].at, x.terms.direction(p.start(), p.step));
  }

  bool move(const PathState& x, const Propagation& p, PathState& y,
            MutationContext& context) const {
    const double size = move_.sample(context.rng.next());
    const double moved = distance(x, p) * std::exp(context.rng.next() < 0.5 ? -size : size);
    const Vec3 w = x.terms.direction(p.start(), p.step);
    const Walker walker{scene(), y.path.time, context.rays};
    Vertex& b = y.path[p.b] = {};
    b.lobe = x[p.b].lobe;
    if (!walker.arrive_at(moved, walker.leave(x[p.start()].at, w), 0, b.at) || !b.at.in_medium())
      return false;
    b.at.p = edge_start(x, p) + moved * w;  // no offset of the ray's start turns the edge
    return true;
  }

  /// The factor, in a measure, of a start that is replaced by itself.
  template <class Measure>
  static double kept(const Measure& in, const Propagation& p) {
    const int start = p.start(), next = start + 1;
    return p.step < 0 && next <= in.x.edges() ? in.step(next, start) / in.x[start].G : 1;
  }

  /// Whether light is scattered in the same ways between c and b in x and in y.
  static bool same_form(const PathState& x, const PathState& y, const Propagation& p) {
    return mlt::same_form(x, y, p.c + 1, p.b - 1);
  }

  ExponentialRadius move_;  ///< Sizes of moves of the logarithm of the distance.
};

}  // namespace

MutationPlugin mutation_propagation() {
  return {{"mutation",
           "propagation",
           "propagation of vertices in media along their edges (Pauly et al. 2000, sec. 4.2).",
           {{"smallest_move", ParamType::real, 0.001,
             "Smallest change of the logarithm of the distance."},
            {"largest_move", ParamType::real, 1.0,
             "Largest change of the logarithm of the distance."}}},
          "propagation_mutation",
          0.2,
          make_shared_mutation<PropagationMutation>,
          /*on=*/true,
          [](const Scene& scene) { return scene.has_media(); }};
}

}  // namespace mlt
