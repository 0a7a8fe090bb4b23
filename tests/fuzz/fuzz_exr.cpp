#include "fuzz.h"

#include "image/exr.h"

void mlt::fuzz::read(std::string_view bytes) {
  decode_exr_metadata(bytes, "input");
  decode_exr(bytes, "input");
  decode_exr(bytes, "input", "x");
}
