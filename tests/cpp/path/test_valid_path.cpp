// Which paths of a damaged checkpoint are refused.
#include "path/valid_path.h"

#include "path/inspect.h"
#include "scenes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mlt::test {
namespace {

/// Whether a path of the scene is still valid with this number in place of its own.
bool is_valid_with(const std::string& name, double wavelength) {
  const ScenePtr scene = make_scene(name).scene;
  Path path = sample_path(*scene, {1}).path;
  EXPECT_TRUE(is_valid_path(*scene, path));
  path.set_wavelength(wavelength);
  return is_valid_path(*scene, path);
}

TEST(ValidPath, HasWavelengthsInSpectralScenesAlone) {
  for (const double u : {0.0, 0.5, 1 - 0x1p-53}) {
    EXPECT_TRUE(is_valid_with("spectral_room", u)) << u;
    EXPECT_FALSE(is_valid_with("cornell", u)) << u;
  }
  for (const double u : {-0.5, 1.0, 1e300, std::nan("")})
    for (const char* name : {"spectral_room", "cornell"}) EXPECT_FALSE(is_valid_with(name, u)) << u;
  EXPECT_TRUE(is_valid_with("cornell", rgb_lanes));
  EXPECT_FALSE(is_valid_with("spectral_room", rgb_lanes));
}

}  // namespace
}  // namespace mlt::test
