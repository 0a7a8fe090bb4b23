#include "mutation/audit.h"

#include "base/error.h"
#include "base/parallel.h"
#include "mutation/audit_tests.h"
#include "mutation/path_seeds.h"

#include <map>

namespace mlt {
namespace {

constexpr double most_splits = 4096;
constexpr size_t most_signatures = 8;  ///< Signatures that have tests of their own ...
constexpr double least_share = 0.01;   ///< ... if they have this share of the light.

class Auditor {
 public:
  Auditor(const PathTarget& target, const PathMixture& mixture, const AuditSettings& how,
          const std::atomic<bool>& cancelled)
      : target_(&target),
        mixture_(mixture),
        how_(how),
        cancelled_(&cancelled),
        layout_(target.scene(), {}),
        samples_(std::max<uint64_t>(1, how.paths / audit_batches)) {}

  AuditReport run() {
    weight_of_step_ = pilot();
    const uint64_t first = samples_;
    const uint64_t most = how_.most_paths > 0 ? how_.most_paths / audit_batches : 16 * first;
    std::vector<AuditSums> done(audit_batches);
    double level = how_.significance;
    uint64_t total = 0;
    for (uint64_t stage = 0;; ++stage) {
      parallel_for(how_.threads, audit_batches, [&](uint64_t i) {
        AuditSums more = batch(stage * audit_batches + i);
        if (stage == 0)
          done[i] = std::move(more);
        else
          done[i].add(more);
      });
      total += samples_;
      const bool last = 2 * total > most;
      if (!last) level /= 2;
      AuditReport found = audit_report(done, layout_, mixture_,
                                       target_->scene().camera().raster().size, total, level);
      found.judge(how_);
      if (last || *cancelled_ || !found.undecided()) return found;
      samples_ = total;
    }
  }

 private:
  /// Mean weight of a sample, roughly, in paths that a mutation suits: as a step's weight, it makes
  /// for one step per sample.
  double pilot() {
    std::map<std::string, double> by_signature;
    PathSeeds seeds = target_->seeds();
    PathMixture mixture = mixture_;
    Rng rng(how_.seed, Purpose::pilot, 0);
    const uint64_t n = std::max<uint64_t>(1000, how_.paths / 10);
    double light = 0, suited = 0;
    PathState x;
    for (uint64_t i = 0; i < n && !*cancelled_; ++i)
      seeds.draw(RandomSampler(rng), [&](const Connection& connection, double weight) {
        light += weight;
        if (!take(seeds, connection, mixture, x)) return;
        suited += weight;
        by_signature[signature(x.terms)] += weight;
      });
    layout_ = AuditLayout(target_->scene(), brightest(by_signature, least_share * suited));
    if (!(light > 0) && !*cancelled_)
      throw RenderError("no light path was found among " + std::to_string(n) + " samples");
    return (suited > 0 ? suited : light) / static_cast<double>(n);
  }

  static std::vector<std::string> brightest(const std::map<std::string, double>& weights,
                                            double least) {
    std::vector<std::pair<double, std::string>> found;
    for (const auto& [signature, weight] : weights)
      if (weight > least) found.emplace_back(-weight, signature);
    std::sort(found.begin(), found.end());
    std::vector<std::string> result;
    for (size_t i = 0; i < std::min(most_signatures, found.size()); ++i)
      result.push_back(found[i].second);
    return result;
  }

  /// Assembles x from a connection; false if no mutation suits it.
  static bool take(const PathSeeds& seeds, const Connection& connection, PathMixture& mixture,
                   PathState& x) {
    seeds.assemble(connection, x);
    return !(x.target > 0) || mixture.suits(x);
  }

  AuditSums batch(uint64_t index) const {
    AuditSums sums;
    for (auto* values : {&sums.expected, &sums.size, &sums.size_squared, &sums.largest})
      values->assign(layout_.summed(), 0);
    for (auto* values : {&sums.chosen, &sums.seen}) values->assign(layout_.plain(), 0);
    sums.moved.assign(1 + longest, 0);
    PathSeeds seeds = target_->seeds();
    PathChain chain(mixture_, Rng(how_.seed, Purpose::inspect, index));
    PathState x;
    Scratch scratch;
    for (uint64_t i = 0; i < samples_ && !*cancelled_; ++i) {
      double weight_of_sample = 0;
      seeds.draw(RandomSampler(chain.rng()), [&](const Connection& connection, double weight) {
        sums.light += weight;
        if (!take(seeds, connection, chain.kernel(), x)) return;
        if (!(x.target > 0)) {
          sums.lost += weight;
          return;
        }
        weight_of_sample += weight;
        const double wanted = weight / weight_of_step_;
        const double splits = std::min(std::floor(wanted + chain.rng().next()), most_splits);
        const double each = wanted < most_splits ? weight_of_step_ : weight / splits;
        for (double s = 0; s < splits; ++s) step(x, each, chain, scratch, sums);
      });
      sums.weight += weight_of_sample;
      sums.weight_squared += sqr(weight_of_sample);
    }
    return sums;
  }

  struct Scratch {
    std::vector<double> before, after, change, step, mean;
    /// Where the blocks begin that a step from x may change, and what becomes of them.
    std::vector<size_t> blocks;
    std::string signature;
  };

  /// g(x) of all functions and signatures.
  void evaluate(const PathState& x, const std::string& signature,
                std::vector<double>& values) const {
    layout_.functions().evaluate(x, values);
    values.resize(layout_.plain(), 0);
    if (const size_t i = layout_.index(signature); i < layout_.signatures())
      values[layout_.functions().size() + i] = 1;
  }

  /// g(y) - g(x) of all functions; 0 if it is no greater than rounding, such as that of a cosine
  /// that is always 1.
  void evaluate_change(const PathState& y, const std::string& signature, Scratch& s) const {
    evaluate(y, signature, s.after);
    s.change.resize(s.after.size());
    for (size_t g = 0; g < s.after.size(); ++g) {
      const double before = s.before[g], after = s.after[g];
      const double rounding = 1e-13 * std::max(std::abs(before), std::abs(after));
      s.change[g] = std::abs(after - before) > rounding ? after - before : 0;
    }
  }

  /// A step, or 0 if it may be rounding.
  static double no_rounding(double step) { return step > 1e-9 ? step : 0; }

  /// How far apart two images of paths are, by the width of the image.
  double step_in_image(const PathState& x, const PathState& y) const {
    return no_rounding(
        length(Vec2(y.raster - x.raster) / Vec2(target_->scene().camera().raster().size)));
  }
  /// The greatest distance between vertices of the same place, by the size of the scene.
  double step_in_space(const PathState& x, const PathState& y) const {
    if (x.edges() != y.edges()) return 0;
    double most = 0;
    for (int i = 0; i <= x.edges(); ++i)
      if (x[i].at.infinite() == y[i].at.infinite())
        most = std::max(most, length(y[i].at.p - x[i].at.p));
    return no_rounding(std::min(1.0, most / target_->scene().bounds().radius));
  }

  /// h(x, y) of all functions that a step from x may change: the plain ones, then by blocks.
  void evaluate_step(const PathState& x, const PathState& y, Scratch& s, double share,
                     AuditSums& sums) const {
    const std::string to = signature(y.terms);
    evaluate_change(y, to, s);
    s.step.assign(s.mean.size(), 0);
    std::copy(s.change.begin(), s.change.end(), s.step.begin());
    const double in_image = step_in_image(x, y);
    const bool same_length = x.edges() == y.edges();
    if (in_image > 0) {
      sums.moved[0] += share;
      if (same_length && x.edges() <= longest) sums.moved[x.edges()] += share;
    }
    double* out = s.step.data() + layout_.plain();
    for (const size_t block : s.blocks) {
      const double factor = block == layout_.in_image()              ? in_image
                            : block == layout_.in_space()            ? step_in_space(x, y)
                            : block >= layout_.of_signature(0)       ? s.signature == to
                            : !same_length                           ? 0
                            : block >= layout_.in_image_of_length(1) ? in_image
                                                                     : 1;
      if (factor != 0)
        for (size_t i = 0; i < layout_.numbers(); ++i)
          out[i] = factor * s.change[layout_.functions().numbers()[i]];
      out += layout_.numbers();
    }
  }

  /// Calls found(place in s.mean, place in the sums, count) for all that a step from x may change.
  template <class Found>
  void for_each_range(const Scratch& s, Found&& found) const {
    found(size_t{0}, size_t{0}, layout_.plain());
    for (size_t i = 0; i < s.blocks.size(); ++i)
      found(layout_.block(i), s.blocks[i], layout_.numbers());
  }

  void step(const PathState& x, double weight, PathChain& chain, Scratch& s,
            AuditSums& sums) const {
    s.signature = signature(x.terms);
    evaluate(x, s.signature, s.before);
    for (size_t g = 0; g < s.before.size(); ++g) sums.seen[g] += s.before[g] != 0;
    s.blocks = {layout_.in_image(), layout_.in_space()};
    if (x.edges() <= longest)
      s.blocks.insert(s.blocks.end(),
                      {layout_.of_length(x.edges()), layout_.in_image_of_length(x.edges())});
    if (const size_t i = layout_.index(s.signature); i < layout_.signatures())
      s.blocks.push_back(layout_.of_signature(i));
    s.mean.assign(layout_.block(s.blocks.size()), 0);
    int recorded = 0;
    const auto record = [&](const PathState& state, double share) {
      if (!(share > 0) || &state == &chain.state()) return;  // x: no change
      ++recorded;
      evaluate_step(x, state, s, weight * share, sums);
      for_each_range(s, [&](size_t from, size_t to, size_t count) {
        for (size_t i = 0; i < count; ++i) {
          s.mean[from + i] += share * s.step[from + i];
          sums.largest[to + i] =
              std::max(sums.largest[to + i], weight * std::abs(s.step[from + i]));
        }
      });
    };
    chain.restart(x);
    const StepResult result = chain.step(record);
    ++sums.steps;
    AuditRow& row = sums.rows[{chain.kernel().chosen(), s.signature}];
    ++row.steps;
    row.generated += chain.kernel().generated(chain.proposal(result, 0));
    row.accepted += result.accepted >= 0;
    row.invalid += result.invalid;
    row.acceptance += result.acceptance;
    if (result.acceptance == 0) return;
    for_each_range(s, [&](size_t from, size_t to, size_t count) {
      for (size_t i = 0; i < count; ++i) {
        const double change = weight * s.mean[from + i];
        sums.expected[to + i] += change;
        sums.size[to + i] += std::abs(change);
        sums.size_squared[to + i] += sqr(change);
      }
    });
    if (result.accepted < 0) return;
    // Else what was accepted is what was recorded last.
    if (recorded > 1) evaluate_change(chain.state(), signature(chain.state().terms), s);
    for (size_t g = 0; g < s.change.size(); ++g) sums.chosen[g] += weight * s.change[g];
  }

  const PathTarget* target_;
  PathMixture mixture_;
  AuditSettings how_;
  const std::atomic<bool>* cancelled_;
  AuditLayout layout_;
  uint64_t samples_;  ///< Samples of each batch of a stage.
  double weight_of_step_ = 0;
};

}  // namespace

AuditReport audit(const PathTarget& target, const PathMixture& mixture, const AuditSettings& how,
                  const std::atomic<bool>& cancelled) {
  return Auditor(target, mixture, how, cancelled).run();
}

AuditReport audit(const PathTarget& target, const Mutations& mutations,
                  const MixtureWeights& weights, const AuditSettings& how,
                  const std::atomic<bool>& cancelled) {
  return audit(target, PathMixture(mutations, std::make_shared<MixtureWeights>(weights)), how,
               cancelled);
}

AuditReport audit(const PathTarget& target, const MutationPtr& mutation, const AuditSettings& how) {
  return audit(target, {mutation}, MixtureWeights(std::vector<double>{1.0}), how);
}

}  // namespace mlt
