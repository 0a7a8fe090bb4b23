// Unknown parameters and integrators: Mitsuba 0.x warns of parameters that a plug-in does not have,
// Mitsuba 2 and 3 refuse them. Programs based on 0.6 have added parameters and integrators of their
// own, and their scenes can be rendered without these.
#pragma once

#include "base/registry.h"
#include "io/node.h"

#include <string>
#include <vector>

namespace mlt {

/// Removes the parameters that are unknown to their plug-ins, except those that look like a
/// misspelt one, and integrators that are not known here. One warning for all of a kind.
void leave_out_unknown(Node& tree, const Registry& registry, std::vector<std::string>& warnings);

/// The name of a parameter since Mitsuba 2, for the names that Mitsuba's own upgrade of older files
/// changes and that snake_case does not cover.
std::string current_name(const Node& node, const std::string& name, const Schema& schema);

}  // namespace mlt
