// <transform>: a sequence of steps, each of which is applied after those before it.
#pragma once

#include "base/schema.h"
#include "io/element.h"

#include <string>
#include <vector>

namespace mlt {

bool is_transform_tag(const std::string& tag);

/// The product of <translate>, <scale>, <rotate>, <lookat> and <matrix>, the last one leftmost.
/// Throws SceneError.
Matrix read_transform(const std::vector<Element>& steps);

}  // namespace mlt
