// Whatever the bytes are, the reader must return a mesh or throw a typed error.
#include "scene/shape/readers.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) {
  try {
    mlt::MeshData mesh = mlt::read_obj({reinterpret_cast<const char*>(bytes), size}, "input");
    mlt::check_mesh(mesh, {"input"});
    mlt::add_smooth_normals(mesh);
  } catch (const mlt::SceneError&) {
  }
  return 0;
}
