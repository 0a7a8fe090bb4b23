#include "scene/volume/nanovdb_file.h"

#include "base/atomic_file.h"
#include "base/error.h"

#ifdef MLT_NANOVDB
#include "scene/volume/nanovdb_tree.h"

#include <fmt/ranges.h>
#include <nanovdb/util/IO.h>
#include <zlib.h>

#include <glm/gtc/matrix_transform.hpp>

#include <cstring>
#endif

namespace mlt {

NanovdbFile read_nanovdb(const std::string& path, const std::string& grid) {
  return parse_nanovdb(read_file(path), grid, path);
}

#ifndef MLT_NANOVDB

NanovdbFile parse_nanovdb(std::string, const std::string&, const std::string& name) {
  throw FileError(name +
                  ": this build does not read NanoVDB files; install NanoVDB (on Debian and "
                  "Ubuntu: apt-get install libnanovdb-dev), and build again");
}

#else
namespace {

struct alignas(NANOVDB_DATA_ALIGNMENT) NanovdbBlock {
  char bytes[NANOVDB_DATA_ALIGNMENT];
};
using NanovdbBlocks = std::vector<NanovdbBlock>;

/// A file is a row of segments: a header, the metadata of some grids, and these grids.
class NanovdbSegments {
 public:
  NanovdbSegments(std::string bytes, const std::string& name)
      : bytes_(std::move(bytes)), name_(name) {}

  NanovdbBlocks find(const std::string& grid) {
    std::vector<std::string> names;
    do {
      const auto header = take<nanovdb::io::Header>();
      check(header);
      std::vector<nanovdb::io::MetaData> grids;
      for (int i = 0; i < header.gridCount; ++i) {
        grids.push_back(take<nanovdb::io::MetaData>());
        const char* text = take(grids.back().nameSize);
        names.emplace_back(text, strnlen(text, grids.back().nameSize));
      }
      auto of_grid = names.end() - header.gridCount;
      for (const auto& found : grids) {
        if (grid.empty() || grid == *of_grid++) return unpack(found.gridSize, header.codec);
        take(found.fileSize);
      }
    } while (at_ < bytes_.size());
    refuse(fmt::format("has no grid '{}'; there are: {}", grid, fmt::join(names, ", ")));
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const { throw FileError(name_ + ": " + what); }

  void check(const nanovdb::io::Header& header) const {
    if (header.magic != NANOVDB_MAGIC_NUMBER)
      refuse("is no NanoVDB file: it should begin with NanoVDB0");
    if (const auto major = header.version.getMajor(); major != NANOVDB_MAJOR_VERSION_NUMBER)
      refuse(fmt::format("has version {} of NanoVDB; only {} is read", major,
                         NANOVDB_MAJOR_VERSION_NUMBER));
  }
  const char* take(uint64_t count) {
    if (count > bytes_.size() - at_)
      refuse(fmt::format("is cut off: it has {} bytes, but goes on", bytes_.size()));
    at_ += count;
    return bytes_.data() + at_ - count;
  }
  template <class T>
  T take() {
    T value;
    std::memcpy(static_cast<void*>(&value), take(sizeof(T)), sizeof(T));
    return value;
  }

  NanovdbBlocks unpack(uint64_t size, nanovdb::io::Codec codec) {
    using nanovdb::io::Codec;
    if (codec != Codec::NONE && codec != Codec::ZIP)
      refuse("is compressed by Blosc, or what is not known; only ZIP is read, and no compression");
    const uint64_t stored = codec == Codec::ZIP ? take<uint64_t>() : size;
    const char* from = take(stored);
    constexpr uint64_t best_ratio = 1032;  // of zlib
    if (size / best_ratio > stored) refuse("is damaged: a grid is larger than it can be");
    NanovdbBlocks blocks(size / sizeof(NanovdbBlock) + 1);
    auto* to = reinterpret_cast<unsigned char*>(blocks.data());
    uLongf unpacked = size;
    if (codec == Codec::NONE)
      std::memcpy(to, from, size);
    else if (uncompress(to, &unpacked, reinterpret_cast<const Bytef*>(from), stored) != Z_OK ||
             unpacked != size)
      refuse("is damaged: a compressed grid cannot be unpacked");
    return blocks;
  }

  std::string bytes_;
  const std::string& name_;
  uint64_t at_ = 0;
};

void read_values(const NanovdbMemory& memory, nanovdb::GridType type, NanovdbFile& file) {
  using nanovdb::GridType;
  switch (type) {
    case GridType::Float: return NanovdbTree<float>(memory).read(file);
    case GridType::Vec3f: return NanovdbTree<nanovdb::Vec3f>(memory).read(file);
    case GridType::Fp4: return NanovdbTree<nanovdb::Fp4>(memory).read(file);
    case GridType::Fp8: return NanovdbTree<nanovdb::Fp8>(memory).read(file);
    case GridType::Fp16: return NanovdbTree<nanovdb::Fp16>(memory).read(file);
    case GridType::FpN: return NanovdbTree<nanovdb::FpN>(memory).read(file);
    default:
      memory.refuse(
          fmt::format("has values of type {}; read are float, Vec3f, Float4, Float8, Float16 and "
                      "FloatN",
                      type < GridType::End ? toStr(type) : "?"));
  }
}

/// Where the map from voxels to the world puts the unit cube that becomes the box of values.
Mat4 place_of(const NanovdbFile& file, const nanovdb::Map& map) {
  Mat4 to_world(1);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) to_world[column][row] = map.mMatD[3 * row + column];
    to_world[3][row] = map.mVecD[row];
  }
  const auto& [low, size] = std::tie(file.low, file.grid.size);
  return glm::scale(glm::translate(to_world, Vec3(low[0], low[1], low[2]) - 0.5),
                    Vec3(size[0], size[1], size[2]));
}

}  // namespace

NanovdbFile parse_nanovdb(std::string bytes, const std::string& grid, const std::string& name) {
  const NanovdbBlocks blocks = NanovdbSegments(std::move(bytes), name).find(grid);
  const NanovdbMemory memory{reinterpret_cast<const char*>(blocks.data()),
                             blocks.size() * sizeof(NanovdbBlock), name};
  const auto& header = memory.at<nanovdb::GridData>(memory.begin, 0);
  if (header.mMagic != NANOVDB_MAGIC_NUMBER ||
      header.mVersion.getMajor() != NANOVDB_MAJOR_VERSION_NUMBER)
    memory.refuse("is damaged: a grid should begin with NanoVDB0 and the version of the file");
  NanovdbFile file;
  read_values(memory, header.mGridType, file);
  file.to_world = place_of(file, header.mMap);
  if (!(std::fabs(glm::determinant(file.to_world)) > 0))
    memory.refuse("has voxels without a volume");
  return file;
}

#endif

}  // namespace mlt
