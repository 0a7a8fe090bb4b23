#include "fuzz.h"

#include "io/load.h"
#include "job/plugins.h"

void mlt::fuzz::read(std::string_view bytes) {
  LoadOptions options;
  options.defines["name"] = "value";
  load_string(std::string(bytes), "tests/python/scenes", plugins(), options);
}
