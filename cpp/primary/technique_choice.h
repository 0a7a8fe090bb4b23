// How often each technique (s, t) is chosen for a fresh path: first the length k, then s. Any
// positive probabilities are right; good ones are in proportion to the light that the techniques
// bring.
#pragma once

#include "math/distribution.h"
#include "path/bidirectional_sampler.h"

#include <vector>

namespace mlt {

class TechniqueChoice {
 public:
  explicit TechniqueChoice(const PathRules& rules) : rules_(rules) {}

  /// The light that techniques have brought in a pilot: by k, then by s. Without any, all
  /// techniques are equally likely.
  void learn(std::vector<std::vector<double>> light);
  const std::vector<std::vector<double>>& light() const { return light_; }

  int sample_length(double u) const;
  double pdf_length(int edges) const;
  /// Among the techniques of one length.
  Technique sample_technique(int edges, double u) const;
  double pdf_technique(const Technique& technique) const;

 private:
  /// So many of the choices do not depend on what has been found up to now.
  static constexpr double blind_share = 0.1;
  /// How likely one edge more is in such choices, where paths may be long.
  static constexpr double one_edge_more = 0.75;
  static constexpr int long_path = 64;

  bool may_be_long() const { return rules_.max_depth < 0 || rules_.max_depth > long_path; }
  int shortest() const { return rules_.min_depth == 1 && !rules_.wants(1) ? 2 : rules_.min_depth; }
  int blind_length(double u) const;
  double blind_pdf(int edges) const;
  /// Learned probabilities of s; nullptr if this length has brought nothing.
  const Discrete* learned(int edges) const;

  PathRules rules_;
  std::vector<std::vector<double>> light_;
  std::vector<Discrete> techniques_;  ///< For each k; empty where there is no light.
  Discrete lengths_;                  ///< Empty without any light.
};

}  // namespace mlt
