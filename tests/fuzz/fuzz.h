// What all fuzz targets share. A target gives foreign bytes to one reader: it must come back, or
// refuse them by an error of ours, in one line. `libfuzzer.cpp` draws the bytes, `replay.cpp` takes
// them from files.
#pragma once

#include "base/error.h"

#include <cstdlib>
#include <string>
#include <string_view>

namespace mlt::fuzz {

/// Each target's own; the bytes are a file of its kind, or should be.
void read(std::string_view bytes);

inline void survive(std::string_view bytes) {
  try {
    read(bytes);
  } catch (const Error& error) {
    if (std::string(error.what()).find_first_of("\r\n") != std::string::npos) std::abort();
  }
}

}  // namespace mlt::fuzz
