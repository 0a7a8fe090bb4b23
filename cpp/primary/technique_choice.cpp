#include "primary/technique_choice.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace mlt {
namespace {

/// Rescales u, which lies in a part of [0, 1), to [0, 1).
double rescaled(double u, double from, double width) {
  return std::min((u - from) / width, 1 - 0x1p-53);
}

}  // namespace

void TechniqueChoice::learn(std::vector<std::vector<double>> light) {
  light_ = std::move(light);
  techniques_.clear();
  std::vector<double> of_length;
  for (const std::vector<double>& row : light_) {
    of_length.push_back(std::accumulate(row.begin(), row.end(), 0.0));
    techniques_.push_back(of_length.back() > 0 ? Discrete(row) : Discrete());
  }
  const bool any = std::any_of(of_length.begin(), of_length.end(), [](double x) { return x > 0; });
  lengths_ = any ? Discrete(of_length) : Discrete();
}

int TechniqueChoice::blind_length(double u) const {
  if (may_be_long()) return shortest() + static_cast<int>(std::log1p(-u) / std::log(one_edge_more));
  return shortest() + static_cast<int>(u * (rules_.max_depth - shortest() + 1));
}
double TechniqueChoice::blind_pdf(int edges) const {
  if (edges < shortest()) return 0;
  if (may_be_long()) return (1 - one_edge_more) * std::pow(one_edge_more, edges - shortest());
  return edges <= rules_.max_depth ? 1.0 / (rules_.max_depth - shortest() + 1) : 0;
}

int TechniqueChoice::sample_length(double u) const {
  if (lengths_.empty()) return blind_length(u);
  if (u < blind_share) return blind_length(rescaled(u, 0, blind_share));
  return static_cast<int>(lengths_.sample(rescaled(u, blind_share, 1 - blind_share)));
}
double TechniqueChoice::pdf_length(int edges) const {
  if (lengths_.empty()) return blind_pdf(edges);
  const bool known = edges < static_cast<int>(lengths_.size());
  return blind_share * blind_pdf(edges) + (known ? (1 - blind_share) * lengths_.pdf(edges) : 0);
}

const Discrete* TechniqueChoice::learned(int edges) const {
  const bool known = edges < static_cast<int>(techniques_.size()) && !techniques_[edges].empty();
  return known ? &techniques_[edges] : nullptr;
}

Technique TechniqueChoice::sample_technique(int edges, double u) const {
  const Discrete* known = learned(edges);
  const double blind = known ? blind_share : 1;
  const int s = u < blind ? static_cast<int>(rescaled(u, 0, blind) * (edges + 2))
                          : static_cast<int>(known->sample(rescaled(u, blind, 1 - blind)));
  return {s, edges + 1 - s};
}
double TechniqueChoice::pdf_technique(const Technique& technique) const {
  const int edges = technique.edges();
  const Discrete* known = learned(edges);
  const double blind = known ? blind_share : 1;
  return blind / (edges + 2) + (known ? (1 - blind) * known->pdf(technique.s) : 0);
}

}  // namespace mlt
