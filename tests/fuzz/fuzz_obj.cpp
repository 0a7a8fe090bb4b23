#include "fuzz.h"

#include "scene/shape/readers.h"

void mlt::fuzz::read(std::string_view bytes) {
  MeshData mesh = read_obj(bytes, "input");
  check_mesh(mesh, {"input"});
  add_smooth_normals(mesh);
}
