// Grids in files: Mitsuba's .vol, version 3.
#pragma once

#include "scene/volume/grid.h"

namespace mlt {

struct VolFile {
  GridData grid;
  Vec3 low{0}, high{1};  ///< The box that the file gives.
};

/// Throws FileError or UsageError.
VolFile read_vol(const std::string& path);
/// Reads the content of a file, called `name` in errors.
VolFile parse_vol(const std::string& bytes, const std::string& name);

}  // namespace mlt
