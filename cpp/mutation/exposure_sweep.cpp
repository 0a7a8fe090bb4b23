#include "mutation/exposure_sweep.h"

#include "path/measure.h"
#include "primary/invert_path.h"
#include "primary/small_step.h"

namespace mlt {
namespace {

/// The place of the number of the time among those of a camera walk.
constexpr size_t number_of_time = 2 + offsetof(LensNumbers, time) / sizeof(double);

/// T / P; 0: no technique makes the path.
double over_density(const PathState& x) {
  const double density = total_density(ContributionMeasure{x.terms});
  return x.target > 0 && density > 0 ? x.target / density : 0;
}

}  // namespace

ExposureSweep::ExposureSweep(const PathTarget& target, const Rng& rng)
    : target_(&target),
      exposures_(target.scene().camera().shutter().exposures),
      rng_(rng),
      due_(rng_.next()) {}

void ExposureSweep::make_all(const PathState& x, MutationScratch& scratch) {
  shares_.assign(1, 1);
  const int s = sample_technique(x.terms, Heuristic::balance, rng_.next());
  const double own = over_density(x);
  if (s < 0 || !(own > 0)) return;
  const Technique technique{s, x.edges() + 1 - s};
  MutationContext context(rng_, scratch);
  PrimaryWalks& walks = context.primary_walks(target_->scene(), target_->rules());
  if (!invert_path(target_->scene(), x.path, technique, rng_, walks.numbers)) return;
  PrimarySamples numbers = walks.numbers;
  double& time = numbers[Stream::camera][number_of_time];
  const double u = time;
  paths_.resize(exposures_);
  shares_.assign(exposures_, 0);
  double sum = shares_[0] = own;
  for (int f = 1; f < exposures_; ++f) {
    time = wrapped(u + double(f) / exposures_);
    if (make(technique, numbers, walks, context, paths_[f]))
      sum += shares_[f] = over_density(paths_[f]);
  }
  for (double& share : shares_) share /= sum;
}

/// Makes y of these numbers; false if they make no path that could be swept, too.
bool ExposureSweep::make(const Technique& technique, const PrimarySamples& numbers,
                         PrimaryWalks& walks, MutationContext& context, PathState& y) const {
  const Scene& scene = target_->scene();
  walks.numbers = numbers;
  PrimarySampler sampler(&walks.numbers, walks.moved, {SmallStep::Shape::kelemen, 0}, context.rng);
  bool found = false;
  walks.paths.sample_technique(technique, sampler, context.rays, [&](const Connection& c) {
    walks.paths.assemble(c, y.path);
    found = true;
  });
  if (!found || !invert_path(scene, y.path, technique, context.rng, walks.numbers)) return false;
  target_->evaluate(y);
  return true;
}

void ExposureSweep::save(ByteWriter& bytes) const {
  bytes.write(rng_.state());
  bytes.write(due_);
}

void ExposureSweep::load(ByteReader& bytes) {
  rng_ = Rng(bytes.read<Rng::State>());
  bytes.read(due_);
  if (!(0 <= due_ && due_ < 1)) throw RenderError("the saved state owes more than a sweep");
}

}  // namespace mlt
