// The scenes that are installed with the program, by name.
#pragma once

#include <string>

namespace mlt {

/// The XML file of `scene`: this path itself, or that of the built-in scene with this name, which
/// may be written door-ajar or door_ajar.
std::string scene_file(const std::string& scene);

}  // namespace mlt
