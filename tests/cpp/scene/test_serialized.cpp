#include <zlib.h>

#include <cstring>

#include "scene/shape/readers.h"
#include "scene/shape_testing.h"

namespace mlt {
namespace {

using namespace shape_testing;

using testing::HasSubstr;

constexpr uint32_t normals = 1, uvs = 2, colors = 8, flat = 16, doubles = 0x2000;

template <class T>
void put(std::string& bytes, T value) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  bytes.append(raw, sizeof(T));
}

std::string compressed(const std::string& bytes) {
  std::string out(compressBound(bytes.size()), '\0');
  uLongf size = out.size();
  compress(reinterpret_cast<Bytef*>(&out[0]), &size, reinterpret_cast<const Bytef*>(bytes.data()),
           bytes.size());
  out.resize(size);
  return out;
}

/// A triangle whose second corner is (scale, 0, 0), claiming the given counts.
std::string mesh(uint16_t version, uint32_t flags, double scale, uint64_t vertices = 3,
                 uint64_t triangles = 1) {
  std::string body;
  put(body, flags);
  if (version == 4) body += std::string("a name") + '\0';
  put(body, vertices);
  put(body, triangles);
  const auto put_all = [&](std::initializer_list<double> values) {
    for (const double x : values) flags& doubles ? put(body, x) : put(body, static_cast<float>(x));
  };
  put_all({0, 0, 0, scale, 0, 0, 0, 1, 0});
  if (flags & normals) put_all({0, 0, 1, 0, 0, 1, 0, 1, 0});
  if (flags & uvs) put_all({0, 0, 1, 0, 0.25, 1});
  if (flags & colors) put_all({9, 9, 9, 9, 9, 9, 9, 9, 9});
  for (const uint32_t index : {0, 1, 2}) put(body, index);
  std::string bytes;
  put<uint16_t>(bytes, 0x041c);
  put(bytes, version);
  return bytes + compressed(body);
}

std::string file(uint16_t version, const std::vector<std::string>& meshes) {
  std::string bytes, table;
  for (const std::string& mesh : meshes) {
    version == 3 ? put(table, static_cast<uint32_t>(bytes.size()))
                 : put(table, static_cast<uint64_t>(bytes.size()));
    bytes += mesh;
  }
  bytes += table;
  put(bytes, static_cast<uint32_t>(meshes.size()));
  return bytes;
}

SerializedMesh read(std::string_view bytes, int64_t index = 0) {
  return read_serialized(bytes, index, "mesh.file");
}
std::string error(std::string_view bytes, int64_t index = 0) {
  return error_of([&] { read(bytes, index); });
}

TEST(Serialized, ReadsEveryMeshOfBothVersions) {
  for (const uint16_t version : {3, 4}) {
    const std::string bytes =
        file(version, {mesh(version, 0x1000, 1), mesh(version, normals | uvs, 2),
                       mesh(version, doubles | normals | uvs | colors, 3),
                       mesh(version, uvs | colors | flat, 4), mesh(version, doubles, 5)});
    for (int64_t i = 0; i < 5; ++i) {
      SCOPED_TRACE(i);
      const SerializedMesh got = read(bytes, i);
      ASSERT_EQ(got.mesh.positions.size(), 3u);
      EXPECT_EQ(got.mesh.positions[1], Vec3f(static_cast<float>(i + 1), 0, 0));
      EXPECT_EQ(got.mesh.normals.size(), i == 1 || i == 2 ? 3u : 0u);
      EXPECT_EQ(got.mesh.uvs.size(), i >= 1 && i <= 3 ? 3u : 0u);
      EXPECT_EQ(got.face_normals, i == 3);
      ASSERT_EQ(got.mesh.triangles.size(), 1u);
      EXPECT_EQ(got.mesh.triangles[0], (std::array<uint32_t, 3>{0, 1, 2}));
    }
    const SerializedMesh third = read(bytes, 2);
    EXPECT_EQ(third.mesh.normals[2], Vec3f(0, 1, 0));
    EXPECT_EQ(third.mesh.uvs[2], Vec2f(0.25f, 1));
  }
}

TEST(Serialized, TruncatedFilesAreSafe) {
  const std::string bytes = file(4, {mesh(4, uvs, 1), mesh(4, doubles, 2)});
  for (const int64_t index : {0, 1})
    expect_truncations_are_safe(bytes, [&](std::string_view cut) { read(cut, index); });
}

TEST(Serialized, DamagedFilesAreSafe) {
  const std::string bytes = file(3, {mesh(3, normals, 1), mesh(3, 0, 2)});
  Rng rng(1, Purpose::test, 0);
  for (int i = 0; i < 3000; ++i) {
    std::string damaged = bytes;
    damaged[rng.below(damaged.size())] = static_cast<char>(rng.below(256));
    for (const int64_t index : {0, 1}) error(damaged, index);
  }
}

TEST(Serialized, LyingCountsTakeNoMemory) {
  EXPECT_EQ(error(file(4, {mesh(4, 0, 1, 4000000000u)})), "mesh.file: the mesh ends too early");
  EXPECT_EQ(error(file(4, {mesh(4, 0, 1, 3, 4000000000u)})), "mesh.file: the mesh ends too early");
  EXPECT_THAT(error(file(4, {mesh(4, 0, 1, uint64_t{1} << 62)})), HasSubstr("2^32 or more"));
}

TEST(Serialized, SaysWhatIsWrong) {
  const std::string good = file(4, {mesh(4, 0, 1), mesh(4, 0, 2)});
  EXPECT_EQ(error(good, 2), "mesh.file: there is no mesh number 2; the file has 2, counted from 0");
  EXPECT_THAT(error(good, -1), HasSubstr("no mesh number -1"));
  EXPECT_THAT(error("solid"), HasSubstr("not a serialized mesh"));
  EXPECT_THAT(error("ply\nformat ascii"), HasSubstr("not a serialized mesh"));
  std::string version = good;
  version[2] = 7;
  EXPECT_THAT(error(version), HasSubstr("version 7 of the serialized format is unknown"));
  std::string table = good;
  table[table.size() - 12] = 9;
  EXPECT_THAT(error(table, 1), HasSubstr("no mesh begins at byte 9"));
  put<uint32_t>(table, 1000000);
  EXPECT_THAT(error(table, 1), HasSubstr("the table at the end of the file is damaged"));
  EXPECT_THAT(error(good.substr(0, 20)), HasSubstr("the file ends within a mesh"));
  std::string damaged = good;
  damaged[4] = 0;
  EXPECT_THAT(error(damaged), HasSubstr("compressed mesh is damaged"));
}

}  // namespace
}  // namespace mlt
