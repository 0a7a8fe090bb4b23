// How the groups of a Metropolis render add up to its image.
//
// Group g starts its chains from a bootstrap of its own, whose weights have the mean b_g. Its chains
// record each state as w2 RGB / T, which has the mean C_g, and how bright that is (L* of it), with
// the mean D_g. Its independent samples record the part S_g of the image, and tell how bright the
// rest is: M_g, the mean of w2 L* / p, the bootstrap included. Since the chains start from the
// candidates that gave b_g, the expectations of
//
//   S_g + b_g C_g,  the image,   and   M_g - b_g D_g,  which is 0,
//
// are right from the first step on (Veach & Guibas 1997, sec. 5.1). But b_g is known badly, and
// chains visit bright and dark regions for times that are not in proportion for long. The image that
// group g tells is therefore
//
//   I_g = S_g + b_g C_g + (M_g - b_g D_g) R_g,   R_g = sum_{h != g} b_h C_h / sum_{h != g} b_h D_h
//
// R_g, the chains' part of the image at brightness 1, comes from the other groups. It is independent
// of its factor, so that the expectation remains right; and the brightness of all is that of the
// independent samples, S_g and M_g.
#pragma once

#include "integrator/weight_sums.h"

#include <vector>

namespace mlt {

/// What a group has done up to now.
struct GroupProgress {
  SampleSums bootstrap, samples;
  uint64_t steps = 0;
  double brightness = 0;  ///< Sum of L* of what its chains have recorded.
};

/// How much of what each group has recorded belongs to an image.
struct GroupScales {
  std::vector<double> chains, samples;
};

class GroupCombination {
 public:
  explicit GroupCombination(std::vector<GroupProgress> groups);

  /// I_g: an image of its own, whose spread over the groups tells the error of their mean.
  GroupScales group(int g) const;
  /// The render's image: the mean of the groups that have begun.
  GroupScales mean() const;
  /// Whether a group has anything to say.
  bool begun(int g) const;

  /// All independent samples, and those of one group.
  const SampleSums& sums() const { return all_; }
  const SampleSums& sums(int g) const { return own_[g]; }

 private:
  int count() const { return static_cast<int>(groups_.size()); }
  double b(int g) const { return groups_[g].bootstrap.target.mean(); }
  bool has_chains(int g) const { return groups_[g].steps > 0; }
  double chain_brightness(int g) const;

  std::vector<GroupProgress> groups_;
  std::vector<SampleSums> own_;
  SampleSums all_;
  double chain_brightness_ = 0;  ///< Sum of b_g D_g.
  bool has_samples_ = false;     ///< Any group has some, beside its bootstrap.
};

}  // namespace mlt
