// OpenEXR takes the value of most attributes for as long as its type wants, not as the file says.
// What follows could then be read in a way that no check has seen, with sizes of any magnitude.
#pragma once

#include <string_view>

namespace mlt {

/// Throws std::runtime_error unless OpenEXR takes exactly the bytes of `value` for an attribute of
/// this type, and allocates no more memory than these are worth.
void check_exr_attribute(std::string_view type, std::string_view value);

}  // namespace mlt
