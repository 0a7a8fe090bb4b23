// Files that gzip has packed.
#pragma once

#include <string>
#include <string_view>

namespace mlt {

/// Whether the bytes begin as gzip's do.
bool is_gzip(std::string_view bytes);

/// What was packed. A FileError, which names the file, if that is damaged or larger than 256 MiB.
std::string unpack_gzip(std::string_view packed, const std::string& name);

}  // namespace mlt
