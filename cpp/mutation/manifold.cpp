// The manifold perturbation (Jakob & Marschner 2012, "Manifold exploration: a Markov chain Monte
// Carlo technique for rendering scenes with difficult specular transport", sec. 5; half vectors of
// nearly specular vertices are kept, as by Kaplanyan, Hanika & Dachsbacher 2014, "The natural-
// constraint representation of the path space for efficient light transport simulation").
//
// Let a, b, c be three vertices that are not specular and follow one another from the camera to the
// light, with specular chains between them, a and c stay unchanged and b moves: the direction
// that leaves a (the image position, if a is on the lens) is perturbed and propagated through the
// chain from a to b, and the chain from b to c is found by a manifold walk. So light that reaches b
// through glass from a small lamp, even a point, is explored, which a ray traced on from b would
// hardly hit.
#include "mutation/edge_visibility.h"
#include "mutation/image_move.h"
#include "mutation/manifold_chain.h"
#include "mutation/measured_mutation.h"
#include "mutation/mutation_registry.h"

namespace mlt {
namespace {

/// Three vertices with nothing but specular ones in between.
struct Triple {
  int a, b, c;

  ManifoldChain chain() const { return {c, b}; }
  bool operator==(const Triple& other) const {
    return a == other.a && b == other.b && c == other.c;
  }
};

class ManifoldPerturbation final : public MeasuredMutation<ManifoldPerturbation> {
 public:
  ManifoldPerturbation(const PathTarget& target, Params& params)
      : MeasuredMutation("manifold", target),
        chain_(target.scene(), step_sizes(params)),
        image_(target.scene(), chain_) {}

  double suitability(const PathState& x) const override { return count_triples(x) > 0 ? 1 : 0; }

  std::optional<Edit> propose(const PathState& x, PathState& y,
                              MutationContext& context) const override {
    const auto count = static_cast<uint64_t>(count_triples(x));
    const Triple t = triple(x, static_cast<int>(context.rng.below(count)));
    const int last = last_moved(x, t);
    const Edit edit{t.c + 1, last, last - t.c};
    splice(x, edit, y);
    const auto ray = first_ray(x, t, y, context.rng);
    if (!ray || !chain_.carry(x, {t.a, t.b, -1}, *ray, y, context)) return std::nullopt;
    if (!scene().bsdf(y[t.b].at).has_smooth()) return std::nullopt;
    if (!t.chain().find(scene(), x, y, context)) return std::nullopt;
    target().evaluate(t.c + 1, last, y);
    if (!(y.target > 0)) return edit;
    if (!same_form(x, y, t) || !t.chain().leads_back(scene(), x, y, context)) return std::nullopt;
    return edit;
  }

  template <class Measure>
  double density_in(const Measure& in, const PathState& x, const PathState& y,
                    const Edit& edit) const {
    const Triple t = triple_of(x, edit);
    if (t.a < 0 || !(t == triple_of(y, edit)) || !same_form(x, y, t)) return 0;
    return t.chain().density(in, scene(), y) / count_triples(x) *
           chain_.walked_density(in, x, y, {t.a, t.b, -1}, first_coefficient(x, y, t));
  }

 private:
  static int last_moved(const PathState& x, const Triple& t) {
    return t.a == x.edges() ? t.a : t.a - 1;
  }

  /// Calls see(triple) for all triples that can be moved.
  template <class See>
  void for_each_triple(const PathState& x, See&& see) const {
    int a = x.edges();
    int b = ChainPerturbation::chain_end(x, a, -1);
    while (b > 0) {
      const int c = ChainPerturbation::chain_end(x, b, -1);
      const Triple triple{a, b, c};
      if (triple.chain().can_be_walked(scene(), x)) see(triple);
      a = b;
      b = c;
    }
  }
  int count_triples(const PathState& x) const {
    return x.known.triples.get([&] {
      int count = 0;
      for_each_triple(x, [&](const Triple&) { ++count; });
      return count;
    });
  }
  Triple triple(const PathState& x, int number) const {
    Triple found{-1, -1, -1};
    for_each_triple(x, [&](const Triple& t) {
      if (number-- == 0) found = t;
    });
    return found;
  }
  /// The triple that an edit has moved; a < 0 if there is none.
  Triple triple_of(const PathState& x, const Edit& edit) const {
    Triple found{-1, -1, -1};
    for_each_triple(x, [&](const Triple& t) {
      if (t.c == edit.first - 1 && last_moved(x, t) == edit.last) found = t;
    });
    return found;
  }

  /// Whether light is scattered in the same ways from a to c in x and in y.
  static bool same_form(const PathState& x, const PathState& y, const Triple& t) {
    return mlt::same_form(x, y, std::max(t.c, 1), std::min(t.a, x.edges() - 1));
  }

  std::optional<Ray> first_ray(const PathState& x, const Triple& t, PathState& y, Rng& rng) const {
    if (t.a == x.edges()) return image_.move(x, y, rng);
    const ExponentialRadius angle = chain_.angle(x, t.a, t.b, -1);
    const Vec3 w = ChainPerturbation::perturb(x.terms.direction(t.a, -1), angle, rng);
    return scene().spawn(x[t.a].at, w, y.path.time);
  }
  double first_coefficient(const PathState& x, const PathState& y, const Triple& t) const {
    if (t.a == x.edges()) return image_.density(x, y);
    const Vec3 from = x.terms.direction(t.a, -1), to = y.terms.direction(t.a, -1);
    return chain_.angle(x, t.a, t.b, -1).angular_pdf(angle_between(from, to)) /
           abs_cos(y[t.a].at, to);
  }

  ChainPerturbation chain_;
  ImageMove image_;
};

}  // namespace

MutationPlugin mutation_manifold() {
  return {{"mutation", "manifold",
           "manifold perturbation of what is lit through specular chains (Jakob & Marschner 2012, "
           "sec. 5).",
           step_size_parameters()},
          "manifold_perturbation",
          0.2,
          make_shared_mutation<ManifoldPerturbation>};
}

}  // namespace mlt
