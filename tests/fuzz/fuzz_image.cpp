// Of every format; what it is follows from its content.
#include "fuzz.h"

#include "image/image_io.h"

void mlt::fuzz::read(std::string_view bytes) { linear_image(read_image_memory(bytes, "input")); }
