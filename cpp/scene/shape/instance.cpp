// Instances of groups of shapes, which are described in scene/accel/instance.h.
#include "scene/accel/instance.h"

#include "base/registry.h"

namespace mlt {

Plugin shape_instance() {
  return make_plugin<Instance>(
      "shape", "instance", "A copy of a group of shapes, which takes hardly any memory.",
      {{"to_world", ParamType::motion, no_default,
        "From the group's space to world space; identity if not given. May mirror and shear."},
       {"shape", ParamType::object, no_default, "The shapegroup, or a reference to it."}});
}

Plugin shape_shapegroup() {
  return make_plugin<ShapeGroup>("shape", "shapegroup",
                                 "Shapes that are there only by way of instances of the group.",
                                 {{"shape", ParamType::object, no_default,
                                   "A shape that does not emit; any number of them."}});
}

}  // namespace mlt
