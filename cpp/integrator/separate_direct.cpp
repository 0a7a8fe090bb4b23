#include "integrator/separate_direct.h"

#include "base/registry.h"
#include "rendering/hidden_lights.h"
#include "scene/scene.h"

namespace mlt {

Plugin integrator_direct();

SeparateDirect separate_direct(ScenePtr scene, uint64_t seed, int samples, bool hide_emitters,
                               bool strict_normals, const LightLayerSettings& light) {
  if (samples == 0) return {};
  for (const EmitterPtr& emitter : scene->emitters())
    if (emitter->delta_direction())
      throw UsageError("direct_samples would lose the direct light of emitter '" + emitter->type +
                       "', which next-event estimation cannot find; leave direct_samples out");
  if (const Emitter* lamp = lamp_on_lens(*scene))
    throw UsageError("direct_samples would lose the light of emitter '" + lamp->type +
                     "' that falls straight on the sensor's shape; leave direct_samples out");
  const Plugin plugin = integrator_direct();
  Params params(plugin.schema, {});
  params.set("hide_emitters", hide_emitters, {});
  params.set("strict_normals", strict_normals, {});
  params.set("light_groups", light.groups, {});
  params.set("light_layers", light.text(), {});
  const auto direct = std::dynamic_pointer_cast<Integrator>(plugin.create(params));
  return {direct->start(std::move(scene), seed), static_cast<double>(samples)};
}

}  // namespace mlt
