// Any text read as a scene ends in a scene or in one of our errors, on one line.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "io/load.h"
#include "render/plugins.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  mlt::LoadOptions options;
  options.defines["name"] = "value";
  const std::string text(reinterpret_cast<const char*>(data), size);
  try {
    mlt::load_string(text, "/nonexistent", mlt::plugins(), options);
  } catch (const mlt::Error& error) {
    if (std::string(error.what()).find('\n') != std::string::npos) std::abort();
  }
  return 0;
}
