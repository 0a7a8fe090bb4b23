// The first byte chooses the mesh; an input marked "raw" is compressed first, so that the fuzzer
// can get behind zlib.
#include "fuzz.h"

#include "scene/shape/readers.h"

#include <zlib.h>

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

void mlt::fuzz::read(std::string_view bytes) {
  if (bytes.empty()) return;
  const std::string_view rest = bytes.substr(1);
  SerializedMesh read = rest.substr(0, 3) == "raw"
                            ? read_serialized(compressed(rest.substr(3)), 0, "input")
                            : read_serialized(rest, static_cast<int8_t>(bytes[0]), "input");
  check_mesh(read.mesh, {"input"});
  add_smooth_normals(read.mesh);
}
