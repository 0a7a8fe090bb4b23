// A grid from a NanoVDB file. It becomes a dense one, so that what lies along a ray is exact as in
// any other; its values stand at the voxels of the file, and fall to 0 next to the outermost ones.
#include "base/registry.h"
#include "scene/texture/texture.h"
#include "scene/transform/transform_params.h"
#include "scene/volume/grid_volume.h"
#include "scene/volume/nanovdb_file.h"

namespace mlt {
namespace {

void multiply(GridData& grid, const Color& factor) {
  if (grid.channels == 1 && factor != Color(factor.x)) {
    std::vector<float> rgb;
    rgb.reserve(3 * grid.values.size());
    for (const float value : grid.values) rgb.insert(rgb.end(), 3, value);
    grid.values = std::move(rgb);
    grid.channels = 3;
  }
  for (size_t i = 0; i < grid.values.size(); ++i)
    grid.values[i] *= static_cast<float>(factor[static_cast<int>(i % 3)]);
}

std::shared_ptr<GridVolume> make_nanovdb(Params& params) {
  const std::string path = params.text("filename");
  NanovdbFile file = read_nanovdb(path, params.text("grid"));
  multiply(file.grid, color_param(params, "scale"));
  const auto& [x, y, z] = file.low;
  const std::string name = fmt::format("{}, from voxel ({}, {}, {}) on", path, x, y, z);
  return std::make_shared<GridVolume>(Grid(file.grid, false, name),
                                      matrix_param(params, "to_world") * file.to_world);
}

}  // namespace

Plugin volume_nanovdb() {
  return {
      {"volume",
       "nanovdb",
       "A grid from a NanoVDB file, where the file places it; outside of it there is nothing.",
       {{"filename", ParamType::text, no_default,
         "A .nvdb file of version 32, compressed by ZIP or not at all."},
        {"grid", ParamType::text, std::string(),
         "The name of the grid; without one, it is the first."},
        {"to_world", ParamType::transform, no_default, "Moves it from where the file places it."},
        {"scale", ParamType::radiance, 1.0,
         "Factor of the values; a colour makes a grid of colours."}}},
      make_nanovdb};
}

}  // namespace mlt
