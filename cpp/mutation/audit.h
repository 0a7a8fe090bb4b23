// The invariance test: does one step of a kernel leave L* unchanged? A Markov kernel is right if
// and only if it does, and that can be tested without waiting for a chain to converge.
//
// Paths x are drawn by bidirectional path tracing, each with its weight w = L*(x) mis(x) / p(x);
// one step of the kernel leads from x to y. For every function g of a path
//
//   E[w g(y)] = E[w g(x)],
//
// so the paired differences w (g(y) - g(x)) have the mean 0. They are summed over batches of
// samples, and the batches enter a t-test; Holm's correction (Holm 1979) covers all functions. Each
// g is tested with the state that was chosen, and, with less noise, with the expected value
// a g(y) + (1 - a) g(x).
//
// A Metropolis step does more: it is reversible, so that E[w h(x, y)] = 0 for every h with
// h(y, x) = -h(x, y). Two kinds of h see what hides in the mean over all paths. g(y) - g(x) where
// both have one length or one signature sees faults of few paths; |y - x| (g(y) - g(x)) sees steps
// whose width depends on x, since the wide ones then lead one way.
//
// The test is sequential. While the least p is small, but not decisive, as many samples again are
// drawn as there are, up to a maximum; half of the significance left is spent on each stage, so
// that the chance of a false alarm over all of them is no greater than was asked for.
//
// That nothing was found means little by itself. So the report says which shift of the image
// position would have been found in nine audits of ten, from the standard errors of these tests.
//
// Weights have heavy tails: a path of weight w takes as many steps as w is large, all of one
// weight, with the remainder left to chance. The variance of the pairs stays small, and a rare
// bright path is not one outlier but many small ones. Paths that no mutation suits stay unchanged
// and take no steps. This does not help if there are too few samples: below 1000 effective ones
// nothing is concluded.
#pragma once

#include "base/parallel.h"
#include "mutation/path_chain.h"

#include <string>
#include <vector>

namespace mlt {

struct AuditSettings {
  uint64_t paths = 100000;  ///< Samples of bidirectional path tracing; in the mean as many steps.
  /// Samples at which an audit that is undecided ends; 0: sixteen times as many as at first.
  uint64_t most_paths = 0;
  uint64_t seed = 1;
  int threads = 1;
  /// Probability of finding any fault in a kernel that has none.
  double significance = 1e-4;
  /// Least number of accepted steps; a kernel that moves less often has not been tested.
  uint64_t least_accepted = 200;
};

/// The test of one function g of the path: the change of its mean by the kernel.
struct AuditTest {
  std::string function;
  bool expected = false;  ///< Whether g is averaged over both states, not of the chosen one.
  double change = 0;      ///< Change of the mean of g under L*: E[w (g(y) - g(x))] / E[w].
  double error = 0;       ///< Standard error of `change`.
  double z = 0;           ///< change / error, a t-statistic.
  double p = 1;           ///< Two-sided p-value of z.
  double adjusted_p = 1;  ///< p after Holm's correction.
};

/// Counts of the steps of one mutation from paths of one signature.
struct AuditRow {
  std::string mutation, signature;
  uint64_t steps = 0, generated = 0, accepted = 0, invalid = 0;
  double acceptance = 0;  ///< Sum of the acceptance over the steps.
};

/// The least shift of the image position in each accepted step that an audit finds nine times in
/// ten.
struct AuditLimit {
  int edges = 0;         ///< Length of the paths that are shifted; 0: all lengths.
  bool or_more = false;  ///< Whether longer ones count, too.
  double pixels = 0;
};

enum class Verdict { nothing_found, wrong, inconclusive };

struct AuditReport {
  Verdict verdict = Verdict::inconclusive;
  std::string reason;  ///< Reason of the verdict, in one sentence.
  double b = 0;        ///< Mean weight of a sample: the integral of L*.
  double suited = 0;   ///< Share of b in paths that a mutation suits; all below is about these.
  double effective_samples = 0;
  uint64_t samples = 0, steps = 0, accepted = 0;
  uint64_t invalid = 0;  ///< Steps whose acceptance was NaN.
  double lost = 0;  ///< Share of b in paths with a weight but without a target: the two must agree.
  std::vector<AuditTest> tests;  ///< In order of p, the least first.
  std::vector<AuditRow> rows;    ///< In order of steps, the most frequent first.
  std::vector<AuditLimit>
      limits;  ///< The first is about all paths; no entry where moves were too few.
  /// From how many edges on too few steps were accepted, and their share of all accepted steps.
  std::pair<int, double> untested{0, 0};
  double level = 0;  ///< The part of the significance that the last stage had.
  /// Changes of more than this many standard errors are found nine times in ten.
  double least_z = 0;

  /// Whether more samples may decide: the least p is small, and not small enough.
  bool undecided() const;
  /// Sets the verdict and its reason.
  void judge(const AuditSettings& how);
  /// A table as text, with the `most` least probable functions and most frequent signatures.
  std::string text(size_t most = 8) const;
};

const char* name_of(Verdict verdict);

/// Tests one step of a mixture. Throws RenderError if no path carries light. The report of a
/// cancelled audit is meaningless.
AuditReport audit(const PathTarget& target, const PathMixture& mixture, const AuditSettings& how,
                  const std::atomic<bool>& cancelled = never_cancelled);
/// Tests one step of a mixture without delayed rejection.
AuditReport audit(const PathTarget& target, const Mutations& mutations,
                  const MixtureWeights& weights, const AuditSettings& how,
                  const std::atomic<bool>& cancelled = never_cancelled);
/// Tests one mutation alone.
AuditReport audit(const PathTarget& target, const MutationPtr& mutation, const AuditSettings& how);

}  // namespace mlt
