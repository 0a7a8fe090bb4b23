// The probability of each technique (s, t) for a fresh path: first the length k, then s. Any
// positive probabilities are right; good ones are in proportion to the light that the techniques
// contribute.
#pragma once

#include "math/distribution.h"
#include "path/bidirectional_sampler.h"

#include <vector>

namespace mlt {

class TechniqueChoice {
 public:
  explicit TechniqueChoice(const PathRules& rules) : rules_(rules) {}

  /// Sets the probabilities by the light of the techniques in a pilot: by k, then by s. Without
  /// any light, all techniques are equally likely.
  void learn(std::vector<std::vector<double>> light);
  const std::vector<std::vector<double>>& light() const { return light_; }

  int sample_length(double u) const;
  double pdf_length(int edges) const;
  /// Samples one of the techniques of a length.
  Technique sample_technique(int edges, double u) const;
  double pdf_technique(const Technique& technique) const;

 private:
  /// The share of the choices that does not depend on the pilot.
  static constexpr double blind_share = 0.1;
  /// The probability of one more edge in such choices, where paths may be long.
  static constexpr double one_edge_more = 0.75;
  static constexpr int long_path = 64;

  bool may_be_long() const { return rules_.max_depth < 0 || rules_.max_depth > long_path; }
  int shortest() const { return rules_.min_depth == 1 && !rules_.wants(1) ? 2 : rules_.min_depth; }
  int blind_length(double u) const;
  double blind_pdf(int edges) const;
  /// Learned probabilities of s; nullptr if no light was found with this length.
  const Discrete* learned(int edges) const;

  PathRules rules_;
  std::vector<std::vector<double>> light_;
  std::vector<Discrete> techniques_;  ///< Choice of s for each k; empty without light.
  Discrete lengths_;                  ///< Choice of k; empty without any light.
};

}  // namespace mlt
