// The names of a scene's shapes and their materials, as its description has them.
#pragma once

#include "io/load.h"

#include <string>
#include <vector>

namespace mlt {

/// Names by place in Scene::shapes(), as name_nodes() gives them.
struct SurfaceNames {
  std::vector<std::string> objects;    ///< Shapes and instances; "" for parts of groups.
  std::vector<std::string> materials;  ///< BSDFs of shapes; "" for instances.
};

/// The name of a material that no shape has asked for.
inline constexpr const char* default_material = "default";

SurfaceNames surface_names(const LoadedScene& loaded, const Registry& registry);

}  // namespace mlt
