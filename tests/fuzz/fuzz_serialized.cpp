// Whatever the bytes are, the reader must return a mesh or throw a typed error. The first byte
// chooses the mesh; an input marked "raw" is compressed first, so that the fuzzer can get behind zlib.
#include <zlib.h>

#include "scene/shape/readers.h"

namespace {

std::string compressed(std::string_view body) {
  std::string bytes(4 + compressBound(body.size()), '\0');
  bytes.replace(0, 4, {'\x1c', '\x04', body.empty() || body[0] % 2 ? '\3' : '\4', '\0'});
  uLongf size = bytes.size() - 4;
  compress2(reinterpret_cast<Bytef*>(&bytes[4]), &size, reinterpret_cast<const Bytef*>(body.data()),
            body.size(), 1);
  bytes.resize(4 + size);
  return bytes;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  if (size == 0) return 0;
  const std::string_view rest(reinterpret_cast<const char*>(data) + 1, size - 1);
  try {
    mlt::SerializedMesh read =
        rest.substr(0, 3) == "raw"
            ? mlt::read_serialized(compressed(rest.substr(3)), 0, "input")
            : mlt::read_serialized(rest, static_cast<int8_t>(data[0]), "input");
    mlt::check_mesh(read.mesh, {"input"});
    mlt::add_smooth_normals(read.mesh);
  } catch (const mlt::SceneError&) {
  }
  return 0;
}
