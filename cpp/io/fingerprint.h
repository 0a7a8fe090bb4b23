// A number that tells one scene from another, so that a render is not resumed with the wrong one.
#pragma once

#include "io/node.h"

#include <cstdint>
#include <optional>

#include "math/vec.h"

namespace mlt {

/// Of the tree's names and values and of the bytes of the files that it reads; where they lie does
/// not count. Throws FileError.
uint64_t fingerprint(const Node& root, const std::optional<Vec2i>& size);

}  // namespace mlt
