// libFuzzer: any bytes are an image or a FileError.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "base/error.h"
#include "image/image_io.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  try {
    mlt::linear_image(mlt::read_image_memory(bytes, "fuzz"));
  } catch (const mlt::FileError&) {
  }
  return 0;
}
