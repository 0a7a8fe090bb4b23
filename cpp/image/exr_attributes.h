// OpenEXR reads most attributes with the size of their type, not with that in the file. The bytes
// that follow could then be read in a way that no check has seen, with sizes of any magnitude.
#pragma once

#include <cstdint>
#include <string_view>

namespace mlt {

/// The four bytes from `position` on as a number; bytes beyond the end count as 0.
uint32_t little_endian(std::string_view bytes, size_t position);

/// Throws std::runtime_error unless OpenEXR takes exactly the bytes of `value` for an attribute of
/// this type, and allocates no more memory than these are worth.
void check_exr_attribute(std::string_view type, std::string_view value);

}  // namespace mlt
