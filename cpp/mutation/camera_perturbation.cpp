#include "mutation/camera_perturbation.h"

#include "mutation/join.h"
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

}  // namespace

CameraPerturbation::Form CameraPerturbation::form(const PathState& x) const {
  Form form;
  int i = ChainPerturbation::chain_end(x, x.edges(), -1);
  for (; i > 1 && x.specular(i - 1); i = ChainPerturbation::chain_end(x, i, -1))
    ++form.further_chains;
  if (i > 0 || x.terms.light_can_be_hit) form.stop = i;
  return form;
}

double CameraPerturbation::suitability(const PathState& x) const {
  const Form f = form(x);
  return f.stop >= 0 && (f.further_chains > 0) == (chains_ == Chains::many) ? 1 : 0;
}

/// Radii on the lens: a thousandth and a third of its own radius.
ExponentialRadius CameraPerturbation::lens_radius() const {
  const double radius = scene_->camera().lens_radius();
  return {1e-3 * radius, radius / 3};
}

std::optional<Edit> CameraPerturbation::propose(const PathState& x, PathState& y,
                                                MutationContext& context) const {
  const int k = x.edges(), stop = form(x).stop;
  const Edit edit{stop, k, k - stop + 1};
  Rng& rng = context.rng;
  const Camera& camera = scene_->camera();
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

  const Ray ray = leave_lens(camera, y[k].at, raster, y.path.time);
  if (!chain_.carry(x, {k, stop, -1}, ray, y, context)) return std::nullopt;
  target_->evaluate(stop, k, y);
  if (stop > 0) join(*scene_, stop, y, context.rays);
  return edit;
}

double CameraPerturbation::density(const PathState& x, const PathState& y, const Edit& edit) const {
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
  if (!scene_->camera().delta_position())
    on_lens =
        lens_moves(x, y) ? 0.5 * lens_radius().planar_pdf(length(y[k].at.p - x[k].at.p)) : 0.5;
  return on_lens * chain_.density(x, y, {k, from.stop, -1}, on_image);
}

MutationPlugin mutation_lens() {
  return {{"mutation", "lens",
           "lens perturbation of paths (L|D)DS*E and LS*E (Veach 1997, sec. 11.3.3.1).",
           step_size_parameters()},
          "lens_perturbation",
          0.3,
          [](const PathTarget& target, Params& params) -> MutationPtr {
            return std::make_shared<CameraPerturbation>("lens", CameraPerturbation::Chains::one,
                                                        target, step_sizes(params));
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
                "multi_chain", CameraPerturbation::Chains::many, target, step_sizes(params));
          }};
}

}  // namespace mlt
