#include "scene/shape/readers.h"
#include "scene/shape_testing.h"

namespace mlt {
namespace {

using namespace shape_testing;

using testing::HasSubstr;

MeshData read(std::string_view text) { return read_obj(text, "mesh.file"); }
std::string error(std::string_view text) {
  return error_of([&] { read(text); });
}

const std::string square =
    "# a square\r\n"
    "mtllib x.mtl\r\n"
    "o thing\r\n"
    "v 0 0 0\r\nv 1 0 0 1.0\r\nv +1 1e0 0\r\nv 0 1. -0\r\n"
    "vt 0 0\r\nvt 1 0 0\r\nvt 1 1\r\nvt 0.5\r\n"
    "vn 0 0 1\r\n"
    "g a\r\nusemtl m\r\ns 1\r\n"
    "f 1/1/1 2/2/1 3/3/1\r\n"
    "g b\r\n"
    "f -4/-4/-1 -2/-2/-1 -1/-1/-1 # the rest\r\n";

TEST(Obj, ReadsAllGroupsAsOneMeshWithSharedVertices) {
  const MeshData mesh = read(square);
  ASSERT_EQ(mesh.positions.size(), 4u);
  ASSERT_EQ(mesh.normals.size(), 4u);
  ASSERT_EQ(mesh.uvs.size(), 4u);
  ASSERT_EQ(mesh.triangles.size(), 2u);
  EXPECT_EQ(mesh.triangles[1], (std::array<uint32_t, 3>{0, 2, 3}));
  EXPECT_EQ(mesh.positions[3], Vec3f(0, 1, 0));
  EXPECT_EQ(mesh.uvs[1], Vec2f(1, 0));
  EXPECT_EQ(mesh.uvs[3], Vec2f(0.5f, 0));
}

TEST(Obj, PolygonsBecomeFans) {
  const MeshData mesh = read("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv -1 .5 0\nf 1 2 3 4 5");
  ASSERT_EQ(mesh.triangles.size(), 3u);
  for (uint32_t i = 0; i < 3; ++i)
    EXPECT_EQ(mesh.triangles[i], (std::array<uint32_t, 3>{0, i + 1, i + 2}));
  EXPECT_TRUE(mesh.normals.empty());
  EXPECT_TRUE(mesh.uvs.empty());
}

TEST(Obj, CornersAreSharedOnlyIfAllThreeIndicesAgree) {
  const MeshData mesh = read(
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nvt 1 1\nvn 0 0 1\nvn 0 1 0\n"
      "f 1/1/1 2/1/1 3/1/1\nf 1/2/1 2/1/2 3/1/1\nf 1/2/1 2/1/2 3/1/1\n");
  EXPECT_EQ(mesh.positions.size(), 5u);
  EXPECT_EQ(mesh.triangles[1], (std::array<uint32_t, 3>{3, 4, 2}));
  EXPECT_EQ(mesh.triangles[2], mesh.triangles[1]);
}

TEST(Obj, ManyCornersAtOnePositionStayDistinct) {
  std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  constexpr int count = 5000;
  for (int i = 0; i < count; ++i) text += "vt " + std::to_string(i) + " 0\n";
  for (int repeat = 0; repeat < 2; ++repeat)
    for (int i = 1; i <= count; ++i) {
      const std::string t = "/" + std::to_string(i);
      text += "f 1" + t + " 2" + t + " 3" + t + "\n";
    }
  const MeshData mesh = read(text);
  EXPECT_EQ(mesh.positions.size(), 3u * count);
  for (size_t i = 0; i < count; ++i) {
    EXPECT_EQ(mesh.triangles[i], mesh.triangles[i + count]);
    EXPECT_EQ(mesh.uvs[mesh.triangles[i][2]].x, static_cast<float>(i));
  }
}

TEST(Obj, FacesWithoutANormalOrUvBesideFacesWithThem) {
  const MeshData mesh = read("v 0 0 0\nv 1 0 0\nv 1 1 0\nvn 0 1 0\nvt 1 1\nf 1//1 2/1 3\n");
  EXPECT_EQ(mesh.normals[0], Vec3f(0, 1, 0));
  EXPECT_EQ(mesh.normals[1], Vec3f(0));
  EXPECT_EQ(mesh.uvs[1], Vec2f(1));
  EXPECT_EQ(mesh.uvs[2], Vec2f(0));
}

TEST(Obj, LinesMayBeContinued) {
  const MeshData mesh = read("v 0 \\\n0 0\nv 1 0 0\nv 1 1 0\nf 1 \\\r\n 2 3\n");
  EXPECT_EQ(mesh.triangles.size(), 1u);
  EXPECT_THAT(error("v 0 \\\n0 0\nv 1 0 0\nv 1 1 0\nf 1 2 7\n"), HasSubstr("mesh.file:5:"));
}

TEST(Obj, NumbersTooSmallForADoubleAreZero) {
  EXPECT_EQ(read("v 1e-999 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n").positions[0], Vec3f(0));
}

TEST(Obj, SaysWhatIsWrongAndWhere) {
  const std::string v = "v 0 0 0\nv 1 0 0\nv 1 1 0\n";
  EXPECT_EQ(error(v + "f 1 2 4\n"),
            "mesh.file:4: a face names vertex 4, but 3 are defined above it");
  EXPECT_EQ(error(v + "f 1 2 0\n"),
            "mesh.file:4: a face names vertex 0, but 3 are defined above it");
  EXPECT_THAT(error(v + "f 1 2 -4\n"), HasSubstr("vertex -4"));
  EXPECT_THAT(error(v + "f 1/1 2/1 3/1\n"), HasSubstr("texture coordinate 1, but 0"));
  EXPECT_THAT(error(v + "f 1//2 2//1 3//1\n"), HasSubstr("normal 2, but 0"));
  EXPECT_EQ(error(v + "f 1 2\n"), "mesh.file:4: a face needs three vertices or more, but has 2");
  EXPECT_THAT(error(v + "f 1 2 3x\n"), HasSubstr("'x' after a face's vertex"));
  EXPECT_THAT(error(v + "f 1 2 99999999999999999999\n"), HasSubstr("is not an index"));
  EXPECT_EQ(error("v 0 zero 0\n"), "mesh.file:1: 'zero' is not a number");
  EXPECT_EQ(error("v 0 0\nv 1 2 3\n"), "mesh.file:1: a number is missing");
  EXPECT_EQ(error("v 0 0 1.5.2\n"), "mesh.file:1: '1.5.2' is not a number");
  EXPECT_EQ(error(v), "mesh.file: the file has no faces");
  EXPECT_EQ(error(""), "mesh.file: the file has no faces");
}

TEST(Obj, TruncatedFilesAreSafe) { expect_truncations_are_safe(square, read); }

}  // namespace
}  // namespace mlt
