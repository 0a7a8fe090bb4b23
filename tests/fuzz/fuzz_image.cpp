// libFuzzer: any bytes are an image or a FileError. The first byte picks the name, since only the
// extension tells TGA.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "base/error.h"
#include "image/image_io.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  if (size == 0) return 0;
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  const char* name = data[0] % 2 == 0 ? "fuzz.exr" : "fuzz.tga";
  try {
    mlt::linear_image(mlt::read_image_memory(bytes, name));
  } catch (const mlt::FileError&) {
  }
  return 0;
}
