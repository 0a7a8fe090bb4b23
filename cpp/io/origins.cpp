#include "io/origins.h"

#include "scene/transform/motion.h"

namespace mlt {
namespace {

/// T(-after) M T(before), for a matrix that is stored row by row.
Matrix moved(Matrix m, const Vec3& before, const Vec3& after) {
  for (int row = 0; row < 4; ++row)
    for (int k = 0; k < 3; ++k) m[4 * row + 3] += m[4 * row + k] * before[k];
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column) m[4 * row + column] -= after[row] * m[12 + column];
  return m;
}

constexpr Matrix identity{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

}  // namespace

Vec3 origin_of(const Bounds& bounds) {
  constexpr double far = 8;
  return length(bounds.center) > far * bounds.radius ? bounds.center : Vec3(0);
}

void move_place(Params& params, const Vec3& before, const Vec3& after) {
  if (before == Vec3(0) && after == Vec3(0)) return;
  for (const char* point : {"position", "origin", "target"})
    if (params.has(point)) {
      const Triple p = params.triple(point);
      return params.replace(point, Triple{p[0] - after.x, p[1] - after.y, p[2] - after.z});
    }
  const char* name = "to_world";
  const Parameter* place = params.schema().find(name);
  if (!place || (place->type == ParamType::transform && params.schema().family != "volume")) return;
  if (const Animation* animation = animation_param(params, name)) {
    Animation keys = *animation;
    for (Keyframe& key : keys) key.transform = moved(key.transform, before, after);
    return params.replace(name, keys);
  }
  if (!params.has(name)) params.set(name, identity, params.where());
  params.replace(name, moved(params.matrix(name), before, after));
}

}  // namespace mlt
