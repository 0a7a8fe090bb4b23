// Mutations beside those of the registry.
#pragma once

#include "mutation/path_chain.h"

#include <functional>
#include <string>

namespace mlt {

/// A mutation that is not in the registry, such as one that is written in Python.
struct ExtraMutation {
  std::string name;
  double weight;
  std::function<MutationPtr(const PathTarget&)> make;
};

}  // namespace mlt
