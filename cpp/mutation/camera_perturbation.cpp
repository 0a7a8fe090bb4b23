// What the two perturbations that start at the lens share: the image position moves by a small
// distance (and, with a lens of finite aperture, half of the time the point on the lens too) and
// the path follows, up to the diffuse vertex that is joined to the rest. They differ in the paths
// that they suit:
//
// The lens perturbation (Veach & Guibas 1997, sec. 5.3.2.1; Veach 1997, sec. 11.3.3.1) has the form
// (L|D)DS*E: it explores what is seen directly, in mirrors and through glass.
//
// The multi-chain perturbation (sec. 5.3.2.3; sec. 11.3.3.3) has the form (L|D)(DS+)+DS*E, such as
// a caustic seen through glass: where the path goes on from a diffuse vertex to another specular
// chain, the direction is perturbed by a small angle and carried through that chain, and so on, for
// any number of chains.
//
// Where specular vertices lead on to the light, LS*E and L(S+D)+S*E, nothing can be joined; Veach
// leaves these paths to the bidirectional mutation. Here the whole path follows, and its end has to
// hit a light again: so a lamp is explored in a mirror, and what it lights through glass, seen
// through glass.
#include "mutation/chain_perturbation.h"
#include "mutation/join.h"
#include "mutation/measured_mutation.h"
#include "mutation/mutation_registry.h"

namespace mlt {
namespace {

/// Both ways of the lens point are equally likely: to stay, or to move.
bool lens_moves(const PathState& x, const PathState& y) {
  return x[x.edges()].at.p != y[y.edges()].at.p;
}

/// A perturbation does not go from one light at infinity to another, nor to or from a surface.
bool same_light_at_infinity(const PathState& x, const PathState& y) {
  return x[0].at.infinite() == y[0].at.infinite() &&
         (!x[0].at.infinite() || x[0].emitter == y[0].emitter);
}

class CameraPerturbation final : public MeasuredMutation<CameraPerturbation> {
 public:
  enum class Chains { one, many };

  CameraPerturbation(std::string name, Chains chains, const PathTarget& target, Params& params)
      : MeasuredMutation(std::move(name), target),
        chains_(chains),
        chain_(target.scene(), step_sizes(params)) {}

  double suitability(const PathState& x) const override {
    const Form f = form(x);
    return f.stop >= 0 && (f.further_chains > 0) == (chains_ == Chains::many) ? 1 : 0;
  }

  std::optional<Edit> propose(const PathState& x, PathState& y,
                              MutationContext& context) const override {
    const int k = x.edges(), stop = form(x).stop;
    const Edit edit{stop, k, k - stop + 1};
    Rng& rng = context.rng;
    const Camera& camera = scene().camera();
    splice(x, edit, y);
    y.path[k] = x[k];
    if (!camera.delta_position() && rng.next() < 0.5) {
      const double r = lens_radius().sample(rng.next()), phi = 2 * pi * rng.next();
      const auto moved = camera.move_on_lens(x[k].at, {r * std::cos(phi), r * std::sin(phi)});
      if (!moved) return std::nullopt;
      y.path[k].at = *moved;
    }
    const double r = chain_.image_radius().sample(rng.next()), phi = 2 * pi * rng.next();
    const Vec2 raster = x.raster + r * Vec2(std::cos(phi), std::sin(phi));
    if (!camera.raster().contains(raster)) return std::nullopt;

    const Ray ray = leave_lens(camera, y[k].at, raster);
    if (!chain_.carry(x, {k, stop, -1}, ray, y, context)) return std::nullopt;
    target().evaluate(stop, k, y);
    if (stop > 0) join(scene(), stop, y, context.rays);
    return edit;
  }

  template <class Measure>
  double density_in(const Measure& in, const PathState& x, const PathState& y,
                    const Edit& edit) const {
    const Form from = form(x), to = form(y);
    if (from.stop != to.stop || from.further_chains != to.further_chains || from.stop != edit.first)
      return 0;
    if (from.stop == 0 && !same_light_at_infinity(x, y)) return 0;
    for (int i = from.stop; i < x.edges(); ++i)
      if (x.specular(i) != y.specular(i)) return 0;
    const int k = x.edges();
    const double on_image = chain_.image_radius().planar_pdf(glm::length(y.raster - x.raster)) *
                            chain_.raster_per_direction(y);
    double on_lens = 1;
    if (!scene().camera().delta_position())
      on_lens =
          lens_moves(x, y) ? 0.5 * lens_radius().planar_pdf(length(y[k].at.p - x[k].at.p)) : 0.5;
    return on_lens * chain_.density(in, x, y, {k, from.stop, -1}, on_image);
  }

 private:
  struct Form {
    /// The diffuse vertex that is joined to the rest; 0: a light that is hit; -1: neither.
    int stop = -1;
    int further_chains = 0;
  };

  Form form(const PathState& x) const {
    Form form;
    int i = ChainPerturbation::chain_end(x, x.edges(), -1);
    for (; i > 1 && x.specular(i - 1); i = ChainPerturbation::chain_end(x, i, -1))
      ++form.further_chains;
    if (i > 0 || x.terms.light_can_be_hit) form.stop = i;
    return form;
  }

  /// Radii on the lens: a thousandth and a third of its own radius.
  ExponentialRadius lens_radius() const {
    const double radius = scene().camera().lens_radius();
    return {1e-3 * radius, radius / 3};
  }

  Chains chains_;
  ChainPerturbation chain_;
};

}  // namespace

MutationPlugin mutation_lens() {
  return {{"mutation", "lens",
           "lens perturbation of paths (L|D)DS*E and LS*E (Veach 1997, sec. 11.3.3.1).",
           step_size_parameters()},
          "lens_perturbation",
          0.3,
          [](const PathTarget& target, Params& params) -> MutationPtr {
            return std::make_shared<CameraPerturbation>("lens", CameraPerturbation::Chains::one,
                                                        target, params);
          }};
}

MutationPlugin mutation_multi_chain() {
  return {{"mutation", "multi_chain",
           "multi-chain perturbation of paths (L|D)(DS+)+DS*E and L(S+D)+S*E (Veach 1997, sec. "
           "11.3.3.3).",
           step_size_parameters()},
          "multi_chain_perturbation",
          0.2,
          [](const PathTarget& target, Params& params) -> MutationPtr {
            return std::make_shared<CameraPerturbation>(
                "multi_chain", CameraPerturbation::Chains::many, target, params);
          }};
}

}  // namespace mlt
