// The image position moves by up to side / 2 pixels in x and in y, and what is seen there takes the
// place of x_{k-1}. On the image a step is as likely as its reverse; in the area measure of x_{k-1}
//   q(x -> y) = 1 / side^2 * d(pixels) / d(area),
// where a camera walk, which fills the sampled pixels evenly, has the latter in its density.
#include "mutation/edge_visibility.h"
#include "mutation/mutation_registry.h"

namespace mlt {
namespace {

class Nudge final : public Mutation {
 public:
  Nudge(const PathTarget& target, Params& own)
      : Mutation("nudge", target), side_(own.real_in("side", 1e-6, 1e6)) {}

  double suitability(const PathState& x) const override {
    const int k = x.edges();
    return k > 1 && !x[k - 1].delta() && !x[k - 2].delta() ? 1 : 0;
  }
  std::optional<Edit> propose(const PathState& x, PathState& y,
                              MutationContext& context) const override {
    const int k = x.edges();
    const Edit edit{k - 1, k - 1, 1};
    splice(x, edit, y);
    const Vec2 u{context.rng.next(), context.rng.next()}, raster = x.raster + side_ * (u - 0.5);
    const Ray ray = camera_ray(scene().camera(), x[k].at, raster);
    const Walker walk{scene(), ray.time, context.rays};
    if (!walk.arrive(ray, walk.draw_leg(context.rng), y.path[k - 1])) return std::nullopt;
    target().evaluate(k - 1, k - 1, y);
    test_visibility(scene(), k - 1, y, context.rays);
    return edit;
  }
  double density(const PathState&, const PathState& y, const Edit& edit) const override {
    return y.terms[edit.first].from_camera * scene().camera().raster().sampled_area() / sqr(side_);
  }

 private:
  double side_;
};

}  // namespace

MutationPlugin mutation_nudge() {
  const Parameter side{"side", ParamType::real, 4.0, "Side of the square it moves in, in pixels."};
  return {{"mutation", "nudge", "nudge of the image position.", {side}},
          "nudge_mutation",
          0.1,
          make_shared_mutation<Nudge>};
}

}  // namespace mlt
