// A tree of nodes as bytes and back, so that what was asked for can be kept in a file, and a number
// that tells one tree from another.
#pragma once

#include "base/bytes.h"
#include "io/node.h"
#include "math/vec.h"

#include <functional>
#include <map>

namespace mlt {

/// Properties only: locations are left out, and a node from bytes has none.
void save(ByteWriter& bytes, const Node& node);

/// Throws RenderError for bytes that are no node.
Node load_node(ByteReader& bytes);

/// Calls use(path) for the name of every file that the tree reads, in order; and of those that do
/// not exist, since a film's file name is one to write.
void for_each_file(Node& node, const std::function<void(std::string& path)>& use);

/// Of a file's content. Throws FileError.
std::string file_hash(const std::string& path);

/// A number that tells one scene from another, so that a render is not resumed with the wrong one:
/// of the tree's names and values and of the bytes of the files that it reads; where they lie does
/// not count. `file_hashes` are those known, and become those of all. Throws FileError.
uint64_t fingerprint(Node tree, const std::optional<Vec2i>& size,
                     std::map<std::string, std::string>& file_hashes);

}  // namespace mlt
