// The shapes that are made of a few triangles: the cube and the rectangle.
#include "scene/mesh.h"
#include "scene/shape/common.h"
#include "scene/texture.h"

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

/// [-1, 1]^3 with normals outward; every face has its own uv square, laid as in Mitsuba.
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

/// [-1, 1]^2 in the plane z = 0, with the normal +z; uv runs from 0 to 1 along x and y.
MeshData rectangle() {
  return {{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}},
          {},
          {{0, 0}, {1, 0}, {1, 1}, {0, 1}},
          {{0, 1, 2}, {0, 2, 3}}};
}

/// A mesh without vertex normals whose triangles turn counter-clockwise seen from outside; they do
/// so too if `to_world` mirrors it.
Plugin flat_shape(const char* name, const char* doc, MeshData (*make)()) {
  return {shape_schema(name, doc,
                       {{"face_normals", ParamType::boolean, false,
                         "Accepted for files that set it; the shape is flat anyway."}}),
          [make](Params& params) {
            params.boolean("face_normals");
            MeshData data = make();
            const Mat4 to_world = matrix_param(params, "to_world");
            if (glm::determinant(Mat3(to_world)) < 0)
              for (auto& corners : data.triangles) std::swap(corners[1], corners[2]);
            return std::make_shared<Mesh>(std::move(data), to_world, true,
                                          params.boolean("flip_normals"), params.where());
          }};
}

}  // namespace

Plugin shape_cube() { return flat_shape("cube", "The cube from (-1, -1, -1) to (1, 1, 1).", cube); }

Plugin shape_rectangle() {
  return flat_shape("rectangle", "A square of side 2 in the xy plane that faces +z.", rectangle);
}

}  // namespace mlt
