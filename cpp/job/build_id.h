#pragma once

namespace mlt {

/// The identity of the library: a hash of its sources, its compiler and its flags.
const char* build_id();

}  // namespace mlt
