// The square [-1, 1] x [-1, 1] in the plane z = 0, with the normal +z; uv runs from 0 to 1 along x
// and y.
#include "scene/shape/common.h"

namespace mlt {
namespace {

MeshData rectangle() {
  return {{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}},
          {},
          {{0, 0}, {1, 0}, {1, 1}, {0, 1}},
          {{0, 1, 2}, {0, 2, 3}}};
}

}  // namespace

Plugin shape_rectangle() {
  return flat_shape_plugin("rectangle", "A square of side 2 in the xy plane that faces +z.",
                           rectangle);
}

}  // namespace mlt
