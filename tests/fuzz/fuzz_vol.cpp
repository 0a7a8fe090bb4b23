#include "fuzz.h"

#include "scene/volume/grid_volume.h"
#include "scene/volume/vol_file.h"

/// A grid that can be read can be flown through.
void mlt::fuzz::read(std::string_view bytes) {
  const VolFile file = parse_vol(std::string(bytes), "input");
  const GridVolume volume(Grid(file.grid, bytes.size() % 2 == 0, "input"), Mat4(1));
  volume.at({0.3, 0.6, 0.2}, mlt::rgb_lanes);
  volume.fly({{-1, -0.9, -0.8}, normalize(Vec3(1, 1.1, 0.9))}, {infinity, Spectrum(1), 0.5}, 1);
}
