// A scene description as bytes, with the files that it reads, so that another process or machine
// can build the same scene.
#pragma once

#include "io/load.h"

#include <string>

namespace mlt {

std::string pack(const Node& node);
Node unpack_node(const std::string& packed);

/// Packs the tree, the image size that was asked for, and the content of every file that the tree
/// names. Throws FileError if one of them cannot be read any more.
std::string pack(const LoadedScene& loaded);

/// Builds the scene again, with the same hash. Its files are put into a temporary folder meanwhile.
/// Throws RenderError for bytes that are damaged, otherwise as build_scene does.
LoadedScene unpack_scene(const std::string& packed, const Registry& registry);

}  // namespace mlt
