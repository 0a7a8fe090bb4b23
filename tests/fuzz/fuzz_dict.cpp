// The tree that a dict of Python or an XML file becomes, with its files, as other processes get it.
#include "fuzz.h"

#include "io/pack.h"
#include "job/plugins.h"

void mlt::fuzz::read(std::string_view bytes) { unpack_scene(std::string(bytes), plugins()); }
