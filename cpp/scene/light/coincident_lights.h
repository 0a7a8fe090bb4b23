#pragma once

#include <string>
#include <vector>

namespace mlt {

class Scene;

/// A warning for each emissive shape in whose surface another shape lies, at least partly: which of
/// them a ray hits depends on rounding, so that next-event estimation and walks that hit a light
/// have different images.
std::vector<std::string> warnings_of_coincident_lights(const Scene& scene);

}  // namespace mlt
