// The cube [-1, 1]^3 with normals outward; every face has its own uv square, laid as in Mitsuba.
#include "scene/shape/common.h"

namespace mlt {
namespace {

/// A face seen from outside: its centre, and the directions in which u and v grow.
struct Face {
  Vec3f center, u, v;
};

const std::array<Face, 6>& faces() {
  static const std::array<Face, 6> all{{{{1, 0, 0}, {0, 1, 0}, {0, 0, -1}},
                                        {{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                        {{0, 1, 0}, {-1, 0, 0}, {0, 0, -1}},
                                        {{0, -1, 0}, {0, 0, 1}, {1, 0, 0}},
                                        {{0, 0, 1}, {0, 1, 0}, {1, 0, 0}},
                                        {{0, 0, -1}, {0, -1, 0}, {1, 0, 0}}}};
  return all;
}

MeshData cube() {
  MeshData data;
  for (const Face& f : faces()) {
    const auto first = static_cast<uint32_t>(data.positions.size());
    for (const Vec2f uv : {Vec2f(0, 0), Vec2f(1, 0), Vec2f(1, 1), Vec2f(0, 1)}) {
      data.positions.push_back(f.center + (2 * uv.x - 1) * f.u + (2 * uv.y - 1) * f.v);
      data.uvs.push_back(uv);
    }
    const bool outward = dot(cross(Vec3(f.u), Vec3(f.v)), Vec3(f.center)) > 0;
    const uint32_t second = outward ? 1 : 3, fourth = outward ? 3 : 1;
    data.triangles.push_back({first, first + second, first + 2});
    data.triangles.push_back({first, first + 2, first + fourth});
  }
  return data;
}

}  // namespace

Plugin shape_cube() {
  return flat_shape_plugin("cube", "The cube from (-1, -1, -1) to (1, 1, 1).", cube);
}

}  // namespace mlt
