#include "job/build_id.h"

#include "mlt_build_id.h"

namespace mlt {

const char* build_id() { return MLT_BUILD_ID; }

}  // namespace mlt
