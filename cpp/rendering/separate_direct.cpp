#include "rendering/separate_direct.h"

#include "base/registry.h"

namespace mlt {

Plugin integrator_direct();

SeparateDirect separate_direct(ScenePtr scene, uint64_t seed, int samples, bool hide_emitters,
                               bool strict_normals) {
  if (samples == 0) return {};
  const Plugin plugin = integrator_direct();
  Params params(plugin.schema, {});
  params.set("hide_emitters", hide_emitters, {});
  params.set("strict_normals", strict_normals, {});
  const auto direct = std::dynamic_pointer_cast<Integrator>(plugin.create(params));
  return {direct->start(std::move(scene), seed), static_cast<double>(samples)};
}

}  // namespace mlt
