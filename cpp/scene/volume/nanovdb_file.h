// Grids in NanoVDB files (Museth 2021, "NanoVDB: A GPU-friendly and portable VDB data structure for
// real-time rendering and simulation"), of version 32.
#pragma once

#include "scene/volume/grid.h"

namespace mlt {

struct NanovdbFile {
  GridData grid;           ///< The box of all that is not 0, with a layer of zeros around it.
  std::array<int, 3> low;  ///< The voxel in the file that its first value is.
  Mat4 to_world{1};        ///< Where the file has the unit cube, of which the box is made.
};

/// The grid of this name, or the first one if the name is empty. Throws FileError or UsageError.
NanovdbFile read_nanovdb(const std::string& path, const std::string& grid);
/// Reads the content of a file, called `name` in errors.
NanovdbFile parse_nanovdb(std::string bytes, const std::string& grid, const std::string& name);

}  // namespace mlt
