// The entry of every target that clang's libFuzzer runs.
#include "fuzz.h"

#include <cstddef>
#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  mlt::fuzz::survive({reinterpret_cast<const char*>(data), size});
  return 0;
}
