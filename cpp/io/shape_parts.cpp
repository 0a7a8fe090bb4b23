#include "io/shape_parts.h"

#include "scene/accel/instance.h"
#include "scene/emitter/moving.h"
#include "scene/mesh/mesh.h"
#include "scene/transform/motion.h"

namespace mlt {
namespace {

bool needs_a_shape(const Emitter& emitter) { return !emitter.infinite() && !emitter.delta(); }

void prepare_sampling(Shape& shape) {
  if (auto* mesh = dynamic_cast<Mesh*>(&shape)) mesh->prepare_sampling();
}

}  // namespace

std::vector<std::string> attached(const std::string& family) {
  if (family != "shape") return {};
  return {"bsdf", "emitter", "sensor", "interior", "exterior"};
}

void attach_light(Shape& shape, const EmitterPtr& light) {
  if (!needs_a_shape(*light))
    throw SceneError(at(
        light->where, "emitter '{}' cannot be attached to a shape; put it directly into the scene",
        light->type));
  prepare_sampling(shape);
  light->set_shape(&shape);
  shape.set_emitter(light);
}

void attach_sensor(Shape& shape, Camera& sensor, Params& params) {
  if (shape.as_instance() || animation_param(params, "to_world"))
    throw SceneError(at(sensor.where,
                        "sensor '{}' needs a shape that stands still, and no instance or ellipsoid",
                        sensor.type));
  prepare_sampling(shape);
  sensor.set_shape(&shape);
}

ShapePtr moving(const ShapePtr& shape, Params& params) {
  const Animation* animation = animation_param(params, "to_world");
  if (!animation) return shape;
  const Motion motion = Motion(*animation).after(glm::inverse(at_rest(*animation)));
  const auto instance = std::make_shared<Instance>(shape, motion);
  if (!shape->emitter()) return instance;
  shape->set_emitter(std::make_shared<MovingEmitter>(shape->emitter_ptr(), *instance));
  instance->set_emitter(shape->emitter_ptr());
  return instance;
}

}  // namespace mlt
