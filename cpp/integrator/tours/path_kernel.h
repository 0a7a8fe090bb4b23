// Moves the light paths of chains that render.
#pragma once

#include "mutation/exposure_sweep.h"
#include "mutation/path_chain.h"
#include "mutation/path_target.h"
#include "path/valid_path.h"
#include "rendering/metropolis_chain.h"

namespace mlt {

class PathKernel : public PathMixture, public KernelDefaults {
 public:
  PathKernel(const PathTarget& target, const PathMixture& mixture, const ChainId& id)
      : PathMixture(mixture), target_(&target), sweep_(target, id.rng(Purpose::exposures)) {}

  void record(ChainRecorder& recorder, const PathState& x, double weight) {
    if (!sweep_.wanted() || !recorder.tells_exposures()) return record_one(recorder, x, weight);
    sweep_(x, weight, scratch(),
           [&](const PathState& y, double share) { record_one(recorder, y, share); });
  }
  void record_one(ChainRecorder& recorder, const PathState& x, double weight) const {
    recorder.record(x.raster, x.rgb / x.target, weight,
                    recorder.wants_density() ? target_->over_density(x) : 1,
                    recorder.layers_of(x.path));
  }
  Vec2 raster_of(const PathState& x) const { return x.raster; }

  /// The row of the statistics: there is one for each mutation and row of its weights.
  size_t stats_row() const { return chosen() * (longest_row + 1) + std::min(row(), longest_row); }
  size_t stats_rows() const { return moves().size() * (longest_row + 1); }
  RayCounts& rays() { return scratch().rays; }
  void count_own(ChainStats::Row& row) {
    WalkFailures& failures = scratch().failures;
    row.failed_walks += failures.there;
    row.failed_returns += failures.back;
    failures = {};
  }
  std::string signature(const PathState& x) const { return mlt::signature(x.terms); }

  void save_progress(ByteWriter& bytes) const {
    if (sweep_.wanted()) sweep_.save(bytes);
  }
  void load_progress(ByteReader& bytes) {
    if (sweep_.wanted()) sweep_.load(bytes);
  }
  void save(ByteWriter& bytes, const PathState& x) const { mlt::save(bytes, x.path); }
  void load(ByteReader& bytes, PathState& x) {
    mlt::load(bytes, x.path);
    if (!is_valid_path(target_->scene(), x.path))
      throw RenderError("the saved state has a path that the scene cannot have");
    target_->evaluate(x);
  }

 private:
  const PathTarget* target_;
  ExposureSweep sweep_;
};

/// Names of the rows of the statistics; `weights` may have rows of their own for each length.
std::vector<MutationStats> path_kernel_rows(const Mutations& mutations,
                                            const MixtureWeights& weights);

}  // namespace mlt
