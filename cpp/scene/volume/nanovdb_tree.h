// The values of a NanoVDB tree: a root with tiles of 4096^3 voxels, below it nodes with 32^3 and
// 16^3 children, and leaves of 8^3 voxels. A file says where the nodes lie; here it is not trusted.
#pragma once

#include "base/error.h"
#include "scene/volume/nanovdb_file.h"

#include <nanovdb/util/GridChecksum.h>

#include <algorithm>

namespace mlt {

/// The bytes of one grid, aligned as NanoVDB wants them.
struct NanovdbMemory {
  const char* begin;
  uint64_t size;
  const std::string& name;  ///< For errors.

  [[noreturn]] void refuse(const std::string& what) const { throw FileError(name + ": " + what); }

  /// What lies at an offset from a part of the grid, with `more` bytes behind it.
  template <class T>
  const T& at(const void* part, uint64_t offset, uint64_t more = 0) const {
    const uint64_t place = static_cast<const char*>(part) - begin + offset;
    if (place % NANOVDB_DATA_ALIGNMENT != 0 || place > size || sizeof(T) > size - place ||
        more > size - place - sizeof(T))
      refuse("is damaged: a part of the grid lies outside of it");
    return *reinterpret_cast<const T*>(begin + place);
  }
};

/// Build is NanoVDB's name for how values are stored.
template <class Build>
class NanovdbTree {
 public:
  explicit NanovdbTree(const NanovdbMemory& memory)
      : memory_(memory), grid_(memory.at<nanovdb::NanoGrid<Build>>(memory.begin, 0)) {
    constexpr uint64_t header = sizeof(nanovdb::GridData), tree_size = sizeof(nanovdb::TreeData<>);
    const auto& tree = memory_.at<nanovdb::TreeData<>>(&grid_, header);
    root_ = &memory_.at<Root>(&tree, tree.mNodeOffset[3]);
    memory_.at<Root>(root_, 0, root_->mTableSize * uint64_t{sizeof(Tile)});
    if (reinterpret_cast<const char*>(root_) < memory_.begin + header + tree_size)
      memory_.refuse("is damaged: its root lies in its header");
    if (!nanovdb::validateChecksum(grid_, nanovdb::ChecksumMode::Partial))
      memory_.refuse("is damaged: its checksum is another one");
    if (!(root_->mBackground == Value(0)))
      memory_.refuse("is not 0 outside of its voxels, as a density is");
  }

  void read(NanovdbFile& file) {
    constexpr int channels = sizeof(Value) / sizeof(float);
    std::array<int64_t, 3> low, size;
    find_box(low, size);
    check_grid_size(size, channels, memory_.name);
    file.grid = {{int(size[0]), int(size[1]), int(size[2])}, channels, {}};
    file.low = {int(low[0]), int(low[1]), int(low[2])};
    file.grid.values.resize(size_t(channels) * size[0] * size[1] * size[2]);
    visit_cubes([&](const nanovdb::Coord& corner, int edge, const Value& value) {
      const int64_t x = corner[0] - low[0], y = corner[1] - low[1], z = corner[2] - low[2];
      for (int64_t k = z; k < z + edge; ++k)
        for (int64_t j = y; j < y + edge; ++j) {
          Value* row =
              reinterpret_cast<Value*>(file.grid.values.data()) + (k * size[1] + j) * size[0];
          std::fill(row + x, row + x + edge, value);
        }
    });
  }

 private:
  using Upper = nanovdb::NanoUpper<Build>;
  using Root = typename nanovdb::NanoRoot<Build>::DataType;
  using Tile = typename Root::Tile;
  using Value = typename Root::ValueT;

  /// The box of all values that are not 0, and the zeros around it.
  void find_box(std::array<int64_t, 3>& low, std::array<int64_t, 3>& size) {
    std::array<int64_t, 3> high;
    low.fill(std::numeric_limits<int32_t>::max());
    high.fill(std::numeric_limits<int32_t>::min());
    visit_cubes([&](const nanovdb::Coord& corner, int edge, const Value&) {
      for (int axis = 0; axis < 3; ++axis) {
        low[axis] = std::min<int64_t>(low[axis], corner[axis]);
        high[axis] = std::max(high[axis], int64_t{corner[axis]} + edge);
      }
    });
    for (int axis = 0; axis < 3; ++axis) {
      if (low[axis] >= high[axis]) low[axis] = high[axis] = 0;
      size[axis] = high[axis] - --low[axis] + 1;
    }
  }

  /// Calls visit(corner, edge, value) for cubes, down to single voxels, whose value is not 0.
  template <class Visit>
  void visit_cubes(Visit&& visit) {
    unvisited_ = memory_.size;
    const Tile* tiles = reinterpret_cast<const Tile*>(root_ + 1);
    for (uint32_t i = 0; i < root_->mTableSize; ++i) {
      const nanovdb::Coord corner = Root::KeyToCoord(tiles[i].key);
      if (tiles[i].child)
        visit_node<Upper>(root_, tiles[i].child, corner, visit);
      else
        visit_cube<Upper>(corner, tiles[i].value, visit);
    }
  }
  template <class Node, class Visit>
  void visit_cube(const nanovdb::Coord& corner, const Value& value, Visit&& visit) {
    if (!(value == Value(0))) visit(corner, 1 << Node::TOTAL, value);
  }
  template <class Node, class Visit>
  void visit_node(const void* parent, uint64_t offset, const nanovdb::Coord& corner,
                  Visit&& visit) {
    using Data = typename Node::DataType;
    const Data& node = memory_.at<Data>(parent, offset);
    if (sizeof(Data) > unvisited_) memory_.refuse("is damaged: it has a node in many places");
    unvisited_ -= sizeof(Data);
    if constexpr (Node::LEVEL == 0)
      visit_leaf<Node>(node, corner, visit);
    else
      visit_children<Node>(node, corner, visit);
  }
  template <class Node, class Visit>
  void visit_children(const typename Node::DataType& node, const nanovdb::Coord& corner,
                      Visit&& visit) {
    using Child = typename Node::ChildNodeType;
    for (uint32_t i = 0; i < Node::SIZE; ++i) {
      const nanovdb::Coord at = corner + (Node::OffsetToLocalCoord(i) << Child::TOTAL);
      if (node.mChildMask.isOn(i))
        visit_node<Child>(&node, node.mTable[i].child, at, visit);
      else
        visit_cube<Child>(at, node.mTable[i].value, visit);
    }
  }
  template <class Leaf, class Visit>
  void visit_leaf(const typename Leaf::DataType& leaf, const nanovdb::Coord& corner,
                  Visit&& visit) {
    if constexpr (std::is_same_v<Build, nanovdb::FpN>) {
      constexpr int most = 4;  // 2^4 bits for each value
      if (leaf.mFlags >> 5 > most) memory_.refuse("is damaged: values have too many bits");
      memory_.at<typename Leaf::DataType>(&leaf, 0, leaf.memUsage() - sizeof(leaf));
    }
    for (uint32_t i = 0; i < Leaf::SIZE; ++i) {
      const Value value = leaf.getValue(i);
      if (!(value == Value(0))) visit(corner + Leaf::OffsetToLocalCoord(i), 1, value);
    }
  }

  const NanovdbMemory& memory_;
  const nanovdb::NanoGrid<Build>& grid_;
  const Root* root_;
  uint64_t unvisited_ = 0;  ///< Bytes, so that a walk ends: no node has two parents.
};

}  // namespace mlt
