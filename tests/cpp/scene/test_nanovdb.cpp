// Grids in NanoVDB files, which NanoVDB itself writes here and samples.
#include <gmock/gmock.h>

#include "scene/volume/nanovdb_file.h"
#include "scene_pieces.h"
#include "shape_testing.h"

#ifdef MLT_NANOVDB
#include <nanovdb/util/GridBuilder.h>
#include <nanovdb/util/IO.h>
#include <nanovdb/util/SampleFromVoxels.h>
#include <zlib.h>

#include <glm/gtc/matrix_transform.hpp>

#include "base/atomic_file.h"
#include "scene/volume/grid_volume.h"
#endif

namespace mlt {
namespace {

using shape_testing::error_of;
using testing::HasSubstr;

#ifndef MLT_NANOVDB

TEST(Nanovdb, SaysWhatIsToBeInstalled) {
  EXPECT_THAT(error_of([] { parse_nanovdb("", "", "smoke.nvdb"); }), HasSubstr("libnanovdb-dev"));
}

#else

using nanovdb::Coord;
using nanovdb::CoordBBox;
using nanovdb::io::Codec;
using Handle = nanovdb::GridHandle<>;

/// Turned, stretched and moved.
nanovdb::Map map() {
  const Mat4 m = glm::translate(
                 glm::rotate(glm::scale(Mat4(1), Vec3(0.5, 1, 2)), 0.4, Vec3(1, 2, 3)),
                 Vec3(1, -2, 3)),
             inverse = glm::inverse(m);
  nanovdb::Map map;
  map.set(m, inverse, 1.0);
  return map;
}

/// Some voxels on both sides of the origin, and a leaf that becomes a tile.
template <class Value>
Value value_at(const Coord& ijk) {
  const auto [x, y, z] = std::array<int, 3>{ijk[0], ijk[1], ijk[2]};
  if (x >= 8 && x < 16 && y >= 8 && y < 16 && z >= 0 && z < 8) return Value(0.7f);
  if ((x & 12) == 4 || (y & 3) == 1) return Value(0.0f);
  return Value(((5 * x + 3 * y + 7 * z) & 31) / 32.0f);
}
template <>
nanovdb::Vec3f value_at(const Coord& ijk) {
  return value_at<float>(ijk) * nanovdb::Vec3f(1, 0.5f, 0.25f * (ijk[0] & 3));
}

constexpr int low[] = {-8, -5, -3}, high[] = {19, 18, 12};

template <class Build>
Handle make(const std::string& name = "density") {
  using Value = typename nanovdb::NanoGrid<Build>::ValueType;
  nanovdb::GridBuilder<Value, Build> builder(Value(0.0f));
  const CoordBBox box(Coord(low[0], low[1], low[2]), Coord(high[0], high[1], high[2]));
  builder([](const Coord& ijk) { return value_at<Value>(ijk); }, CoordBBox(Coord(0), box.max()));
  auto accessor = builder.getAccessor();
  for (auto ijk = box.begin(); ijk; ++ijk)  // not by the builder: it would shift negative numbers
    if (const Value value = value_at<Value>(*ijk); std::min({(*ijk)[0], (*ijk)[1], (*ijk)[2]}) < 0)
      if (!(value == Value(0.0f))) accessor.setValue(*ijk, value);
  return builder.getHandle(map(), name);
}

template <class... Handles>
std::string file_of(Handles&&... handles) {
  std::vector<Handle> grids;
  (grids.push_back(std::move(handles)), ...);
  const test::TemporaryFile file("grids.nvdb");
  nanovdb::io::writeGrids(file.path(), grids);
  return read_file(file.path());
}

template <class Build>
class NanovdbOf : public testing::Test {};
using Builds =
    testing::Types<float, nanovdb::Vec3f, nanovdb::Fp4, nanovdb::Fp8, nanovdb::Fp16, nanovdb::FpN>;
TYPED_TEST_SUITE(NanovdbOf, Builds);

TYPED_TEST(NanovdbOf, HasTheValuesThatNanovdbSamples) {
  const Handle handle = make<TypeParam>();
  const auto& grid = *handle.template grid<TypeParam>();
  const auto accessor = grid.getAccessor();
  const auto sampler = nanovdb::createSampler<1>(accessor);
  const NanovdbFile file = parse_nanovdb(file_of(make<TypeParam>()), "", "a file");
  const GridVolume volume(Grid(file.grid, false, "a file"), file.to_world);
  Rng rng(1, Purpose::test, 0);
  int positive = 0;
  for (int i = 0; i < 5000; ++i) {
    nanovdb::Vec3d index;
    for (int axis = 0; axis < 3; ++axis)
      index[axis] = low[axis] - 3 + rng.next() * (high[axis] - low[axis] + 6);
    const nanovdb::Vec3d world = grid.indexToWorld(index);
    const auto expected = sampler(index);
    const Spectrum found = volume.at({world[0], world[1], world[2]}, rgb_lanes);
    positive += found[0] > 0;
    for (int c = 0; c < 3; ++c) {
      if constexpr (std::is_same_v<TypeParam, nanovdb::Vec3f>)
        ASSERT_NEAR(found[c], expected[c], 1e-5);
      else
        ASSERT_NEAR(found[c], expected, 1e-5);
    }
  }
  EXPECT_GT(positive, 2000);
}

TEST(Nanovdb, IsTheDenseGridOfItsVoxelsWithinZeros) {
  const NanovdbFile file = parse_nanovdb(file_of(make<float>()), "density", "a file");
  EXPECT_EQ(file.low, (std::array<int, 3>{low[0] - 1, low[1] - 1, low[2] - 1}));
  std::vector<float> expected;
  for (int z = low[2] - 1; z <= high[2] + 1; ++z)
    for (int y = low[1] - 1; y <= high[1] + 1; ++y)
      for (int x = low[0] - 1; x <= high[0] + 1; ++x) {
        const bool inside = low[0] <= x && x <= high[0] && low[1] <= y && y <= high[1] &&
                            low[2] <= z && z <= high[2];
        expected.push_back(inside ? value_at<float>(Coord(x, y, z)) : 0);
      }
  ASSERT_EQ(file.grid.values.size(), expected.size());
  for (size_t i = 0; i < expected.size(); ++i) ASSERT_EQ(file.grid.values[i], expected[i]) << i;
}

TEST(Nanovdb, IsFoundByItsNameAmongOthers) {
  const std::string bytes =
      file_of(make<nanovdb::Vec3f>("colour"), make<float>("density"), make<nanovdb::Fp8>("heat")) +
      file_of(make<nanovdb::Fp4>("coarse"));
  EXPECT_EQ(parse_nanovdb(bytes, "", "a file").grid.channels, 3);
  const auto values = parse_nanovdb(file_of(make<float>()), "", "a file").grid.values;
  EXPECT_EQ(parse_nanovdb(bytes, "density", "a file").grid.values, values);
  EXPECT_NE(parse_nanovdb(bytes, "coarse", "a file").grid.values, values);
  EXPECT_THAT(error_of([&] { parse_nanovdb(bytes, "smoke", "a.nvdb"); }),
              HasSubstr("a.nvdb: has no grid 'smoke'; there are: colour, density, heat, coarse"));
}

/// As NanoVDB compresses a grid: the size, and a stream of zlib.
std::string zipped(const std::string& bytes, uint64_t header) {
  std::string packed(compressBound(bytes.size()), '\0');
  uLongf size = packed.size();
  compress(reinterpret_cast<Bytef*>(&packed[0]), &size,
           reinterpret_cast<const Bytef*>(&bytes[header]), bytes.size() - header);
  std::string all = bytes.substr(0, header);
  all[14] = static_cast<char>(Codec::ZIP);
  all.append(reinterpret_cast<const char*>(&size), sizeof(size));
  return all + packed.substr(0, size);
}

constexpr uint64_t header_size = 16 + 176 + 8;  // "density" with its end

TEST(Nanovdb, MayBeCompressed) {
  const std::string plain = file_of(make<float>()), packed = zipped(plain, header_size);
  EXPECT_LT(packed.size(), plain.size() / 2);
  EXPECT_EQ(parse_nanovdb(packed, "", "a file").grid.values,
            parse_nanovdb(plain, "", "a file").grid.values);
  std::string blosc = packed;
  blosc[14] = static_cast<char>(Codec::BLOSC);
  EXPECT_THAT(error_of([&] { parse_nanovdb(blosc, "", "a file"); }), HasSubstr("Blosc"));
  for (const size_t size : {packed.size() - 1, size_t{header_size + 9}, size_t{header_size + 3}})
    EXPECT_THAT(error_of([&] { parse_nanovdb(packed.substr(0, size), "", "a.nvdb"); }),
                HasSubstr("a.nvdb: is cut off"));
  std::string torn = packed;
  torn[torn.size() / 2] ^= 1;
  EXPECT_THAT(error_of([&] { parse_nanovdb(torn, "", "a file"); }),
              HasSubstr("cannot be unpacked"));
}

TEST(Nanovdb, MayBeEmpty) {
  nanovdb::GridBuilder<float> builder;
  const NanovdbFile file = parse_nanovdb(file_of(builder.getHandle()), "", "a file");
  EXPECT_EQ(GridVolume(Grid(file.grid, false, "a file"), file.to_world).maximum(), Color(0));
}

TEST(Nanovdb, RefusesWhatIsNoDensity) {
  const auto refusal = [](auto&& builder) {
    return error_of([&] { parse_nanovdb(file_of(builder.getHandle()), "", "a.nvdb"); });
  };
  EXPECT_THAT(refusal(nanovdb::GridBuilder<float>(3)), HasSubstr("a.nvdb: is not 0 outside"));
  EXPECT_THAT(refusal(nanovdb::GridBuilder<int32_t>(0)),
              HasSubstr("a.nvdb: has values of type int32"));
  nanovdb::GridBuilder<float> wide;
  wide.getAccessor().setValue(Coord(-2000000000, 0, 0), 1.0f);
  wide.getAccessor().setValue(Coord(2000000000, 0, 0), 1.0f);
  EXPECT_THAT(refusal(wide), HasSubstr("a.nvdb: a grid cannot have 4000000003 x 3 x 3 values"));
}

TEST(Nanovdb, RefusesWhatItIsNotAndWhatIsCutOff) {
  const std::string whole = file_of(make<float>());
  const auto refusal = [](const std::string& bytes) {
    return error_of([&] { parse_nanovdb(bytes, "", "a.nvdb"); });
  };
  EXPECT_THAT(refusal(std::string(300, 'x')), HasSubstr("a.nvdb: is no NanoVDB file"));
  std::string other = whole;
  other[11] ^= 0x20;  // of the major version
  EXPECT_THAT(refusal(other), HasSubstr("only 32 is read"));
  for (size_t size = 0; size < whole.size(); size += size < 3000 ? 1 : 5003)
    EXPECT_THAT(refusal(whole.substr(0, size)), HasSubstr("a.nvdb: is cut off")) << size;
  // All of the grid's header, its tree and its root is in the checksum.
  for (size_t i = 16; i < 672 + 64 + 64 + 32; ++i) {
    std::string damaged = whole;
    damaged[header_size + i] ^= 0x10;
    EXPECT_THAT(refusal(damaged), HasSubstr("a.nvdb: ")) << i;
  }
}

/// Of a grid that has been changed where no checksum tells.
template <class Build, class Damage>
std::string error_after(Damage&& damage) {
  std::string bytes = file_of(make<Build>());
  Handle handle = make<Build>();
  auto& grid = *handle.template grid<Build>();
  grid.data()->mChecksum = nanovdb::GridChecksum::EMPTY;
  damage(*grid.data(), grid.tree(), grid.tree().root().data());
  std::memcpy(&bytes[header_size], handle.data(), handle.size());
  return error_of([&] { parse_nanovdb(bytes, "", "a.nvdb"); });
}

TEST(Nanovdb, TrustsNoOffset) {
  using Upper = nanovdb::NanoUpper<float>;
  const auto upper = [](auto* root) { return root->getChild(root->tile(0))->data(); };
  const auto first = [](auto* node) { return node->mChildMask.template beginOn().pos(); };
  EXPECT_EQ(error_after<float>([](auto&&...) {}), "");
  for (const int64_t bad : {-(int64_t{1} << 62), int64_t{1} << 40, int64_t{1 << 25},
                            std::numeric_limits<int64_t>::max(), int64_t{65}}) {
    const auto outside = HasSubstr("a.nvdb: is damaged: ");
    EXPECT_THAT(
        error_after<float>([&](auto&, auto& tree, auto*) { tree.data()->mNodeOffset[3] = bad; }),
        outside);
    EXPECT_THAT(error_after<float>([&](auto&, auto&, auto* root) { root->tile(0)->child = bad; }),
                outside);
    EXPECT_THAT(error_after<float>([&](auto&, auto&, auto* root) {
                  auto* node = upper(root);
                  node->mTable[first(node)].child = bad;
                }),
                outside);
  }
  EXPECT_THAT(error_after<float>([](auto&, auto&, auto* root) { root->mTableSize = 1u << 31; }),
              HasSubstr("outside"));
  EXPECT_THAT(error_after<float>([&](auto&, auto&, auto* root) {
                auto* node = upper(root);
                const int64_t child = node->mTable[first(node)].child;
                node->mChildMask.setOn();
                for (uint32_t i = 0; i < Upper::SIZE; ++i) node->mTable[i].child = child;
              }),
              HasSubstr("in many places"));
  EXPECT_THAT(error_after<nanovdb::FpN>([](auto&, auto& tree, auto*) {
                tree.template getFirstNode<0>()->data()->mFlags = 0xff;
              }),
              HasSubstr("too many bits"));
  EXPECT_THAT(error_after<float>([](auto& grid, auto&, auto*) { grid.mMap = {}; }),
              HasSubstr("without a volume"));
}

#endif

}  // namespace
}  // namespace mlt
