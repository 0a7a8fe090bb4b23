// The invariance test: does one step of a kernel leave L* unchanged? A Markov kernel is right if
// and only if it does, and that can be seen without waiting for a chain to converge.
//
// Paths x are drawn by bidirectional path tracing, each with its weight w = L*(x) mis(x) / p(x);
// one step of the kernel leads from x to y. For every function g of a path
//
//   E[w g(y)] = E[w g(x)],
//
// so the paired differences w (g(y) - g(x)) have the mean 0. They are summed over batches of
// samples, and the batches enter a t-test; Holm's correction (Holm 1979) covers all functions. Each
// g is tested with the state that was chosen, and with less noise with the expected one, a g(y) +
// (1 - a) g(x).
//
// Weights have heavy tails: a path of weight w takes as many steps as w is large, all of one
// weight, with the remainder left to chance. What chance there is in the pairs stays small, and a
// rare bright path is not one outlier but many small ones. Paths that no mutation suits stay what
// they are and take none. What this cannot repair is too few samples: below 1000 effective ones
// nothing is concluded.
#pragma once

#include "base/parallel.h"
#include "mutation/path_chain.h"

#include <string>
#include <vector>

namespace mlt {

struct AuditSettings {
  uint64_t paths = 100000;  ///< Samples of bidirectional path tracing; in the mean as many steps.
  uint64_t seed = 1;
  int threads = 1;
  /// Chance of finding any fault in a kernel that has none.
  double significance = 1e-4;
  /// A kernel that moves less often has not been tested.
  uint64_t least_accepted = 200;
};

/// One function of the path, and what the kernel did to its mean.
struct AuditTest {
  std::string function;
  bool expected = false;  ///< Of the state with its expected weights, not of the one chosen.
  double change = 0;      ///< Of the mean of g under L*, normalised: E[w (g(y) - g(x))] / E[w].
  double error = 0;       ///< Standard error of it.
  double z = 0;           ///< change / error, a t-statistic.
  double p = 1;           ///< Two-sided.
  double adjusted_p = 1;  ///< After Holm's correction.
};

/// What happened to the paths of one signature.
struct AuditRow {
  std::string mutation, signature;
  uint64_t steps = 0, generated = 0, accepted = 0, invalid = 0;
  double acceptance = 0;  ///< Sum over the steps.
};

enum class Verdict { right, wrong, inconclusive };

struct AuditReport {
  Verdict verdict = Verdict::inconclusive;
  std::string reason;  ///< One sentence.
  double b = 0;        ///< Mean weight of a sample: the integral of L*.
  double suited = 0;   ///< The share of it in paths that a mutation suits; all else is about these.
  double effective_samples = 0;
  uint64_t samples = 0, steps = 0, accepted = 0;
  uint64_t invalid = 0;  ///< Steps whose acceptance was NaN.
  double lost = 0;  ///< Share of b in paths with a weight but without a target: the two must agree.
  std::vector<AuditTest> tests;  ///< The least probable first.
  std::vector<AuditRow> rows;    ///< The most frequent first.

  /// A table to read, with the `most` least probable functions and most frequent signatures.
  std::string text(size_t most = 8) const;
};

const char* name_of(Verdict verdict);

/// Tests one step of a mixture. Throws RenderError if no path carries light. A report that was
/// cancelled says nothing.
AuditReport audit(const PathTarget& target, const PathMixture& mixture, const AuditSettings& how,
                  const std::atomic<bool>& cancelled = never_cancelled);
/// The same without delayed rejection.
AuditReport audit(const PathTarget& target, const Mutations& mutations,
                  const MixtureWeights& weights, const AuditSettings& how,
                  const std::atomic<bool>& cancelled = never_cancelled);
/// Tests one mutation alone.
AuditReport audit(const PathTarget& target, const MutationPtr& mutation, const AuditSettings& how);

}  // namespace mlt
