#include "integrator/separate_direct.h"

#include "base/parallel.h"
#include "base/registry.h"

namespace mlt {

Plugin integrator_direct();

SeparateImage separate_direct(ScenePtr scene, uint64_t seed, int samples, bool hide_emitters,
                              bool strict_normals) {
  if (samples == 0) return {};
  return [=](int threads, const std::atomic<bool>& cancelled) {
    const Plugin plugin = integrator_direct();
    Params params(plugin.schema, {});
    params.set("hide_emitters", hide_emitters, {});
    params.set("strict_normals", strict_normals, {});
    const auto direct = std::dynamic_pointer_cast<Integrator>(plugin.create(params));
    const std::unique_ptr<Rendering> rendering = direct->start(scene, seed);
    rendering->prepare(threads, cancelled);
    parallel_for(threads, rendering->unit_count(samples), [&](uint64_t unit) {
      if (!cancelled) rendering->run_unit(unit);
    });
    return rendering->image();
  };
}

}  // namespace mlt
