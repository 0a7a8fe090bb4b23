// The translucent perturbation: the image position moves by a small distance, and all that is
// behind rough glass or in a medium moves along as it is. From the first vertex that is not
// specular on, directions and distances are kept through media and through surfaces that transmit
// light, up to the last of these, which is joined to the rest. So paths that are scattered many
// times in skin, wax or milk move below its surface as a whole, though each of their edges may be
// shorter than a pixel: the lens perturbation joins the first moved vertex to one that stays, which
// is rejected there.
//
// Between parallel surfaces all vertices are shifted by one vector; the density of keeping a
// direction is 1 by solid angle in any case. (Shifts of paths in media: Gruson, Hua, Vibert,
// Nowrouzezahrai & Hachisuka 2018, "Gradient-domain volumetric photon density estimation".)
#include "mutation/image_move.h"
#include "mutation/measured_mutation.h"
#include "mutation/mutation_registry.h"

namespace mlt {
namespace {

/// Whether light goes on at inner vertex i: in a medium, or to the other side of a surface.
bool goes_on(const PathState& x, int i) {
  if (x[i].at.in_medium()) return true;
  const Vec3& ng = x[i].at.ng;
  return dot(ng, x.terms.direction(i, 1)) * dot(ng, x.terms.direction(i, -1)) < 0;
}

/// The vertex that is joined to the rest, the last one at which light goes on. Where specular
/// vertices lead on from there: the one that ends them, and 0 is a light that is hit. -1: there is
/// none, or it is the first that is not specular.
int last_translucent(const PathState& x) {
  const int first = ChainPerturbation::chain_end(x, x.edges(), -1);
  int last = -1, next = first;
  for (; next > 0 && goes_on(x, next); next = ChainPerturbation::chain_end(x, next, -1))
    last = next;
  if (last < 0) return -1;
  if (last == next + 1) return last < first && x.terms[next].connectable ? last : -1;
  return (next > 0 ? x.terms[next - 1].connectable : x.terms.light_can_be_hit) ? next : -1;
}

class TranslucentPerturbation final : public MeasuredMutation<TranslucentPerturbation> {
 public:
  TranslucentPerturbation(const PathTarget& target, Params& params)
      : MeasuredMutation("translucent", target),
        chain_(target.scene(), step_sizes(params)),
        image_(target.scene(), chain_) {}

  double suitability(const PathState& x) const override { return stop(x) >= 0 ? 1 : 0; }

  std::optional<Edit> propose(const PathState& x, PathState& y,
                              MutationContext& context) const override {
    return image_.propose(target(), x, span(x.edges(), stop(x)), y, context);
  }

  template <class Measure>
  double density_in(const Measure& in, const PathState& x, const PathState& y,
                    const Edit& edit) const {
    const int k = x.edges(), stop = edit.first;
    if (this->stop(x) != stop || this->stop(y) != stop || !same_form(x, y, stop, k)) return 0;
    for (int i = stop; i < k; ++i)
      if (x[i].at.kind != y[i].at.kind) return 0;
    if (stop == 0 && !same_light_at_infinity(x, y)) return 0;
    return chain_.density(in, x, y, span(k, stop), image_.density(x, y));
  }

 private:
  static ChainPerturbation::Span span(int k, int stop) { return {k, stop, -1, true}; }
  static int stop(const PathState& x) {
    return x.known.translucent.get([&] { return last_translucent(x); });
  }

  ChainPerturbation chain_;
  ImageMove image_;
};

bool is_translucent(const Scene& scene) {
  if (scene.has_media()) return true;
  const auto& shapes = scene.shapes();
  return std::any_of(shapes.begin(), shapes.end(), [](const ShapePtr& shape) {
    return !shape->as_instance() && shape->bsdf().has_transmission() && shape->bsdf().has_smooth();
  });
}

}  // namespace

MutationPlugin mutation_translucent() {
  return {{"mutation", "translucent",
           "perturbation of the image position that keeps directions and distances in media and "
           "behind rough glass (after Gruson et al. 2018).",
           step_size_parameters()},
          "translucent_perturbation",
          0.2,
          make_shared_mutation<TranslucentPerturbation>,
          /*on=*/true,
          is_translucent};
}

}  // namespace mlt
