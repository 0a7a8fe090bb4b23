#include "mutation/audit.h"

#include "base/error.h"
#include "base/parallel.h"
#include "mutation/path_functions.h"
#include "mutation/path_seeds.h"

#include <fmt/format.h>

#include <map>
#include <numeric>

namespace mlt {
namespace {

constexpr int batches = 128;
/// A function that hardly ever changes is not tested, since a t-test needs more than a few events:
/// many small changes one way may wait for a few large ones the other way. Nor is one that is 0 for
/// almost all starting paths, since the few that would leave that set are missing.
constexpr double least_effective_changes = 100;
constexpr double most_splits = 4096;

using RowKey = std::pair<size_t, std::string>;  // mutation, signature

/// Sums over the samples of one batch.
struct Batch {
  double light = 0;                        ///< Weight of all paths.
  double weight = 0, weight_squared = 0;   ///< Sums for paths that a mutation suits.
  std::vector<double> expected, chosen;    ///< Sums of w (g(y) - g(x)), for each function.
  std::vector<double> size, size_squared;  ///< Sums of |w (g(y) - g(x))| as expected.
  std::vector<double> largest;             ///< Sums of |w (g(y) - g(x))| if all were accepted.
  std::vector<uint64_t> seen;              ///< Steps from an x with g(x) != 0.
  std::map<RowKey, AuditRow> rows;
  double lost = 0;  ///< Weight of paths without a target.
  uint64_t steps = 0;
};

class Auditor {
 public:
  Auditor(const PathTarget& target, const PathMixture& mixture, const AuditSettings& how,
          const std::atomic<bool>& cancelled)
      : target_(&target),
        mixture_(mixture),
        how_(how),
        cancelled_(&cancelled),
        functions_(target.scene()),
        samples_(std::max<uint64_t>(1, how.paths / batches)) {}

  AuditReport run() {
    weight_of_step_ = pilot();
    std::vector<Batch> done(batches);
    parallel_for(how_.threads, batches, [&](uint64_t i) { done[i] = batch(i); });
    return report(done);
  }

 private:
  /// Mean weight of a sample, roughly, in paths that a mutation suits: as a step's weight, it makes
  /// for one step per sample.
  double pilot() const {
    PathSeeds seeds = target_->seeds();
    PathMixture mixture = mixture_;
    Rng rng(how_.seed, Purpose::pilot, 0);
    const uint64_t n = std::max<uint64_t>(1000, how_.paths / 10);
    double light = 0, suited = 0;
    PathState x;
    for (uint64_t i = 0; i < n && !*cancelled_; ++i)
      seeds.draw(RandomSampler(rng), [&](const Connection& connection, double weight) {
        light += weight;
        if (take(seeds, connection, mixture, x)) suited += weight;
      });
    if (!(light > 0) && !*cancelled_)
      throw RenderError("no light path was found among " + std::to_string(n) + " samples");
    return (suited > 0 ? suited : light) / static_cast<double>(n);
  }

  /// Assembles x from a connection; false if no mutation suits it.
  static bool take(const PathSeeds& seeds, const Connection& connection, PathMixture& mixture,
                   PathState& x) {
    seeds.assemble(connection, x);
    return !(x.target > 0) || mixture.suits(x);
  }

  Batch batch(uint64_t index) const {
    Batch sums;
    for (auto* values :
         {&sums.expected, &sums.chosen, &sums.size, &sums.size_squared, &sums.largest})
      values->assign(functions_.size(), 0);
    sums.seen.assign(functions_.size(), 0);
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
    std::vector<double> before, after, mean;
  };
  /// The change of a function; 0 if it is no greater than rounding, such as that of a cosine that
  /// is always 1.
  static double change_of(const Scratch& s, size_t g) {
    const double before = s.before[g], after = s.after[g];
    const double rounding = 1e-13 * std::max(std::abs(before), std::abs(after));
    return std::abs(after - before) > rounding ? after - before : 0;
  }

  void step(const PathState& x, double weight, PathChain& chain, Scratch& s, Batch& sums) const {
    functions_.evaluate(x, s.before);
    for (size_t g = 0; g < s.before.size(); ++g) sums.seen[g] += s.before[g] != 0;
    s.mean.assign(functions_.size(), 0);
    const auto record = [&](const PathState& state, double share) {
      functions_.evaluate(state, s.after);
      for (size_t g = 0; g < s.mean.size(); ++g) {
        const double change = change_of(s, g);
        s.mean[g] += share * change;
        if (share > 0) sums.largest[g] = std::max(sums.largest[g], weight * std::abs(change));
      }
    };
    chain.restart(x);
    const StepResult result = chain.step(record);
    ++sums.steps;
    AuditRow& row = sums.rows[{chain.kernel().chosen(), signature(x.terms)}];
    ++row.steps;
    row.generated += chain.kernel().generated(chain.proposal(result, 0));
    row.accepted += result.accepted >= 0;
    row.invalid += result.invalid;
    row.acceptance += result.acceptance;
    if (result.acceptance == 0) return;
    for (size_t g = 0; g < s.mean.size(); ++g) {
      const double change = weight * s.mean[g];
      sums.expected[g] += change;
      sums.size[g] += std::abs(change);
      sums.size_squared[g] += sqr(change);
    }
    if (result.accepted < 0) return;
    functions_.evaluate(chain.state(), s.after);
    for (size_t g = 0; g < s.after.size(); ++g) sums.chosen[g] += weight * change_of(s, g);
  }

  AuditReport report(const std::vector<Batch>& done) const {
    AuditReport report;
    std::map<RowKey, AuditRow> rows;
    double light = 0, weight = 0, weight_squared = 0;
    for (const Batch& batch : done) {
      light += batch.light;
      weight += batch.weight;
      weight_squared += batch.weight_squared;
      report.steps += batch.steps;
      report.lost += batch.lost;
      for (const auto& [key, row] : batch.rows) {
        AuditRow& sum = rows[key];
        sum.steps += row.steps;
        sum.generated += row.generated;
        sum.accepted += row.accepted;
        sum.invalid += row.invalid;
        sum.acceptance += row.acceptance;
      }
    }
    for (auto& [key, row] : rows) {
      row.mutation = mixture_.moves()[key.first]->name();
      row.signature = key.second;
      report.accepted += row.accepted;
      report.invalid += row.invalid;
      report.rows.push_back(row);
    }
    std::stable_sort(report.rows.begin(), report.rows.end(),
                     [](const AuditRow& a, const AuditRow& b) { return a.steps > b.steps; });
    report.samples = samples_ * batches;
    report.b = light / static_cast<double>(report.samples);
    report.suited = weight / light;
    report.lost /= light;
    report.effective_samples = weight > 0 ? sqr(weight) / weight_squared : 0;
    if (weight > 0) add_tests(done, weight, report);
    report.judge(how_);
    return report;
  }

  void add_tests(const std::vector<Batch>& done, double weight, AuditReport& report) const {
    for (size_t g = 0; g < functions_.size(); ++g) {
      double size = 0, size_squared = 0, largest = 0;
      uint64_t seen = 0;
      for (const Batch& batch : done) {
        largest = std::max(largest, batch.largest[g]);
        size += batch.size[g];
        size_squared += batch.size_squared[g];
        seen += batch.seen[g];
      }
      if (!(sqr(size) >= least_effective_changes * size_squared) || size == 0) continue;
      if (size < least_effective_changes * largest) continue;
      if (static_cast<double>(seen) < least_effective_changes) continue;
      for (const bool expected : {true, false}) {
        AuditTest test = t_test(done, expected ? &Batch::expected : &Batch::chosen, g, weight);
        test.function = functions_.names()[g];
        test.expected = expected;
        report.tests.push_back(test);
      }
    }
    std::sort(report.tests.begin(), report.tests.end(),
              [](const AuditTest& a, const AuditTest& b) { return a.p < b.p; });
    double largest = 0;
    for (size_t i = 0; i < report.tests.size(); ++i) {
      const double corrected = report.tests[i].p * static_cast<double>(report.tests.size() - i);
      largest = std::max(largest, std::min(1.0, corrected));
      report.tests[i].adjusted_p = largest;
    }
  }

  static AuditTest t_test(const std::vector<Batch>& done, std::vector<double> Batch::* sums,
                          size_t g, double weight) {
    double mean = 0, variance = 0;
    for (const Batch& batch : done) mean += (batch.*sums)[g] / batches;
    for (const Batch& batch : done) variance += sqr((batch.*sums)[g] - mean) / (batches - 1);
    AuditTest test;
    const double error = std::sqrt(variance / batches);
    test.change = mean * batches / weight;
    test.error = error * batches / weight;
    test.z = error > 0 ? mean / error : 0;
    test.p = two_sided(test.z, batches - 1);
    return test;
  }

  /// P(|T| > |t|) of Student's t, by the normal approximation of Wallace 1959 ("Bounds on normal
  /// approximations to Student's and the chi-square distributions"): accurate to 1 % for
  /// n > 60.
  static double two_sided(double t, double n) {
    const double z = std::sqrt(n * std::log1p(sqr(t) / n)) * (8 * n + 1) / (8 * n + 3);
    return std::erfc(z * std::sqrt(0.5));
  }

  const PathTarget* target_;
  PathMixture mixture_;
  AuditSettings how_;
  const std::atomic<bool>* cancelled_;
  PathFunctions functions_;
  uint64_t samples_;  ///< Samples of each batch.
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
