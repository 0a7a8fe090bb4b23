// How the chains of a Metropolis render add up to their part of its image.
//
// Group g starts its chains from a bootstrap of its own, whose weights T / p have the mean b_g. Its
// chains record each state as w2 RGB / T, with the mean C_g, and the brightness (L*) of that, with
// the mean D_g. The independent samples estimate the brightness that b_g D_g should have: M_g, the
// mean of w2 L* / p, over all samples and the group's bootstrap. Since the chains start from the
// candidates that gave b_g, the expectations of
//
//   b_g C_g, the image,   and   M_g - b_g D_g, which is 0,
//
// are right from the first step on (Veach & Guibas 1997, sec. 5.1). But the variance of b_g is
// large, and chains take long to visit bright and dark regions in proportion. The image of group g
// is therefore
//
//   I_g = b_g C_g + lambda (M_g - b_g D_g) R_g,
//   R_g = sum_{h != g} b_h C_h / sum_{h != g} b_h D_h,   lambda = Var b D / (Var b D + Var M)
//
// R_g, the image at brightness 1, comes from the other groups, independent of M_g - b_g D_g: for
// any fixed lambda the expectation remains right. The brightness is then the mean of the estimates
// by chains and by samples, weighted by their variances. These are estimated from the same render,
// which leaves a bias that vanishes as the render goes on. Without samples that estimate M, as with
// those of path tracing, lambda is 0.
//
// The I_g are not independent: if one group alone has found some light, all others have it in R.
// The error of their mean I is therefore that of a jackknife (Efron & Stein 1981, "The jackknife
// estimate of variance"): with I_-g, the mean without a group, it is told by the spread of
//
//   J_g = I + (n - 1) (mean over h of I_-h - I_-g),
//
// whose mean is I. Where lambda is 0, J_g is I_g.
//
// Tours (markov/tour.h) are scaled by a known number: their b C_g is right by itself, and lambda is
// 0 too. What tours that wait have yet to record is missing in it.
//
// The correction subtracts light from the others' image where a group is too bright, but no more
// than that image can lose: the rest of the excess is subtracted from the group's own C_g, so that
// nothing becomes negative. That is biased as a quotient is, and becomes rarer as the render goes
// on.
#pragma once

#include "math/weight_sums.h"

#include <vector>

namespace mlt {

/// The sums of a group up to now.
struct GroupProgress {
  double b = 0;           ///< Mean of the weights T / p of its bootstrap.
  SampleSums bootstrap;   ///< Brightness of the bootstrap samples.
  uint64_t steps = 0;     ///< Number of steps of its chains.
  double brightness = 0;  ///< Sum of L* of what its chains have recorded.
  double due = 0;         ///< Sum of L* of what they have yet to record.
};

/// How much of what each group has recorded belongs to an image.
using GroupWeights = std::vector<double>;

class GroupEstimator {
 public:
  /// `of_chains`: the mean of w2 L* / p over the samples that all groups share. `corrected`: lambda
  /// is not 0.
  GroupEstimator(std::vector<GroupProgress> groups, const Estimate& of_chains,
                 bool corrected = true);

  /// J_g; from the spread over the groups the error of their mean is estimated.
  GroupWeights group(int g) const;
  /// The mean of the groups that have begun.
  GroupWeights mean() const;
  /// The common error of all groups: R, times the standard error of M, and times missing(), but no
  /// more of this than the chains show: the excess may be anywhere.
  GroupWeights common_error() const;
  /// missing() beyond the brightness of all that the chains show, over this.
  double excess() const;
  /// The brightness that the samples have found beyond that of the image (or below, if negative),
  /// if it is significant: more than 2.5 standard errors. At least that of waiting tours.
  double missing() const { return missing_; }
  /// The brightness that waiting tours have yet to record.
  double waiting() const { return waiting_; }
  /// Whether a group has an image: it has found no light, or its chains have made steps.
  bool begun(int g) const { return groups_[g].b == 0 || has_chains(g); }

 private:
  int count() const { return static_cast<int>(groups_.size()); }
  bool has_chains(int g) const { return groups_[g].steps > 0; }
  double chain_brightness(int g) const;
  Estimate samples_of(int g) const;
  GroupWeights corrected(int g) const;  ///< I_g
  GroupWeights mean_without(int g) const;
  /// By how much I_g is brighter than b_g C_g.
  struct Correction {
    double of_others;  ///< Added to it as the others' image.
    double of_itself;  ///< Taken away from it; not positive.
  };
  Correction correction(int g) const;

  std::vector<GroupProgress> groups_;
  Estimate of_chains_;
  double chain_brightness_ = 0;  ///< Sum of b_g D_g.
  double mean_brightness_ = 0;   ///< Its mean over the groups that have begun.
  double waiting_ = 0;
  double lambda_ = 0, missing_ = 0;
};

}  // namespace mlt
