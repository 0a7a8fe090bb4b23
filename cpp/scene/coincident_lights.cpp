#include "scene/coincident_lights.h"

#include "scene/shape.h"

#include <array>
#include <map>

namespace mlt {
namespace {

/// Points of the shape and its area: shapes with equal values are regarded as coincident.
std::vector<double> fingerprint(const Shape& shape) {
  std::vector<double> values{shape.area()};
  for (const Vec2& u : {Vec2(0.1, 0.7), Vec2(0.4, 0.2), Vec2(0.6, 0.9), Vec2(0.9, 0.4)}) {
    const Vec3 p = shape.sample_position(u).at.p;
    values.insert(values.end(), {p.x, p.y, p.z});
  }
  return values;
}

}  // namespace

std::vector<std::string> warnings_of_coincident_lights(const std::vector<EmitterPtr>& emitters) {
  std::vector<std::string> warnings;
  std::map<std::vector<double>, const Shape*> met;
  for (const EmitterPtr& emitter : emitters) {
    const Shape* shape = emitter->shape();
    if (!shape || shape->as_instance()) continue;
    const auto [first, is_new] = met.emplace(fingerprint(*shape), shape);
    if (is_new) continue;
    const std::string other = describe(first->second->where);
    warnings.push_back(at(shape->where,
                          "this light lies in the same place as another one{}; which of the two is "
                          "seen is left to rounding, so keep one",
                          other.empty() ? "" : " (" + other + ")"));
  }
  return warnings;
}

}  // namespace mlt
