// Other targets than L* for the chains of the laboratory: factors of L* that depend on the path.
#pragma once

#include "light_path.h"

#include "mutation/path_target.h"

namespace mlt::python {

struct FactorSettings {
  std::optional<std::string> paths;  ///< A regular expression for all of a signature.
  py::object weight;  ///< None, a function of a LightPath, or an image of the scene's size.
  double power;       ///< The power of L*.
};

/// The product of the factors that are given; nullptr if there is none. Throws UsageError for one
/// that makes no sense.
PathTarget::PathFactor path_factor(const LoadedPtr& scene, const FactorSettings& settings,
                                   bool strict_normals);

}  // namespace mlt::python
