// Files of Mitsuba 0.x as they were meant: where its plug-ins have another default or another name
// than those of Mitsuba 2 and 3, it is written out (docs/mitsuba.md has the list).
#pragma once

#include "io/element.h"
#include "io/node.h"

#include <string>
#include <vector>

namespace mlt {

/// The spectrum of an element <blackbody name="" temperature="5000K" scale="1"/>.
Node read_blackbody(const Element& e);

/// Changes the nodes that files of version 0 describe (Node::modern), and no others.
void upgrade_version_0(Node& tree, std::vector<std::string>& warnings);

}  // namespace mlt
