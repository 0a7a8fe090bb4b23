// A light path in all exposures of the shutter, so that chains leave to chance in which of the
// frames of a shot they find light, and its noise changes as slowly as the picture.
//
// Numbers u make a path x by a technique s. With the number of the time turned by f / F they make a
// path y_f that another of the F exposures sees, and y_0 = x. If s is drawn with the probability
// p_s / P, where P is the sum of the densities of all techniques, the step from x to y_f with the
// probability
//
//   (T(y_f) / P(y_f)) / sum over g of T(y_g) / P(y_g)
//
// leaves the target T unchanged: this is Gibbs sampling among the y in primary sample space. So
// all y_f may be recorded in place of x, each with this share of its weight.
#pragma once

#include "mutation/mutation.h"

namespace mlt {

class ExposureSweep {
 public:
  ExposureSweep(const PathTarget& target, const Rng& rng);

  /// Whether there are several exposures.
  bool wanted() const { return exposures_ > 1; }
  /// Records x with this weight: calls record(y, weight) for each y, for one state in a few, whose
  /// weight is that of all since the last.
  template <class Record>
  void operator()(const PathState& x, double weight, MutationScratch& scratch, Record&& record) {
    due_ += weight / period();
    const double times = std::floor(due_);
    if (!(times > 0)) return;
    due_ -= times;
    make_all(x, scratch);
    for (size_t f = 0; f < shares_.size(); ++f)
      if (shares_[f] > 0) record(f == 0 ? x : paths_[f], times * period() * shares_[f]);
  }

  void save(ByteWriter& bytes) const;
  void load(ByteReader& bytes);

 private:
  /// Next states of a chain are much alike, and a sweep takes as long as several steps.
  double period() const { return std::max(4.0, 0.5 * exposures_); }
  void make_all(const PathState& x, MutationScratch& scratch);
  bool make(const Technique& technique, const PrimarySamples& numbers, PrimaryWalks& walks,
            MutationContext& context, PathState& y) const;

  const PathTarget* target_;
  int exposures_;
  Rng rng_;
  double due_;                    ///< The share of the next sweep that is due.
  std::vector<PathState> paths_;  ///< The y; that of x itself is not used.
  std::vector<double> shares_;    ///< Their shares.
};

}  // namespace mlt
