// A tree of nodes as bytes and back, so that what was asked for can be kept in a file.
#pragma once

#include "base/bytes.h"
#include "io/node.h"

namespace mlt {

/// Properties only: locations are left out, and a node from bytes has none.
void save(ByteWriter& bytes, const Node& node);

/// Throws RenderError for bytes that are no node.
Node load_node(ByteReader& bytes);

}  // namespace mlt
