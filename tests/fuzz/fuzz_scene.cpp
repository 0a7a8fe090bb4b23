// A scene that is loaded is rendered by every integrator, and no pixel is NaN. File names begin in
// the folder of the tests' scenes.
#include "fuzz.h"
#include "small_render.h"

#include "base/parallel.h"

#include <algorithm>
#include <cmath>

namespace mlt::fuzz {
namespace {

/// A pilot, and an adaptation, take longer than everything else.
const Assignments no_pilot = {{"independent_share", "0"}, {"adaptive", "false"}};

void render(const ScenePtr& scene, const Integrator& integrator) {
  const auto rendering = integrator.start(scene, 1);
  rendering->prepare(1, never_cancelled);
  const uint64_t units = rendering->plan().unit_count(1);
  for (uint64_t unit = 0; unit < units; ++unit) rendering->run_unit(unit);
  const Image image = rendering->image();
  if (std::any_of(image.data.begin(), image.data.end(), [](float v) { return std::isnan(v); }))
    std::abort();
}

}  // namespace

void read(std::string_view bytes) {
  const LoadedScene loaded =
      load_string(std::string(bytes), "tests/python/scenes", plugins(), small_film());
  for (const std::string& name : plugins().names("integrator")) {
    try {
      render(loaded.scene, *small_integrator(loaded, name, no_pilot));
    } catch (const Error&) {  // some scenes suit only some integrators
    }
  }
}

}  // namespace mlt::fuzz
