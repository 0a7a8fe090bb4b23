// Converts a tree of nodes to bytes and back, so that it can be stored in a file, and computes a
// hash that identifies a tree.
#pragma once

#include "base/bytes.h"
#include "io/node.h"
#include "math/vec.h"

#include <functional>
#include <map>

namespace mlt {

/// Saves properties only: locations are left out, and a node from bytes has none.
void save(ByteWriter& bytes, const Node& node);

/// Loads a node. Throws RenderError for bytes that are no node.
Node load_node(ByteReader& bytes);

/// Calls use(path) for every file name in the tree, in order, also if the file does not exist,
/// since a film's file name is one to write.
void for_each_file(Node& node, const std::function<void(std::string& path)>& use);

/// The hash of a file's content. Throws FileError.
std::string file_hash(const std::string& path);

/// A hash that identifies a scene, so that a render is not resumed with the wrong one: of the
/// tree's names and values and of the bytes of the files that it reads, but not their paths.
/// `file_hashes` are those known, and become those of all. Throws FileError.
uint64_t fingerprint(Node tree, const std::optional<Vec2i>& size,
                     std::map<std::string, std::string>& file_hashes);

}  // namespace mlt
