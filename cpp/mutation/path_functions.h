// Functions g of a light path that together detect most errors of a mutation: its image position,
// its length, its light, its vertices, its edges, its colour.
#pragma once

#include "mutation/path_state.h"

#include <string>
#include <vector>

namespace mlt {

class PathFunctions {
 public:
  explicit PathFunctions(const Scene& scene);

  const std::vector<std::string>& names() const { return names_; }
  size_t size() const { return names_.size(); }
  /// Which of them are numbers that vary within a kind of paths, not a case that holds or not.
  const std::vector<size_t>& numbers() const { return numbers_; }
  /// g_0(x) ... g_{n-1}(x).
  void evaluate(const PathState& x, std::vector<double>& values) const;

 private:
  const Scene* scene_;
  std::vector<std::string> names_;
  std::vector<size_t> numbers_;
};

}  // namespace mlt
