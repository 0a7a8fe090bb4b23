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
  EXPECT_EQ(error(v + "f 1 2\n"), "mesh.file: the file has no faces");
  EXPECT_THAT(error("v 0 0 0\nv 1 nan 0\nv 1 1 0\nf 1 2 3\n"),
              HasSubstr("mesh.file:2: the position of a vertex that a face uses is not finite"));
  EXPECT_THAT(error("v 1 -1.#IND 0\nv 0 0 0\nv 1 1 0\nf 1 2 3\n"), HasSubstr("mesh.file:1: "));
  EXPECT_THAT(error(v + "f 1 2 3x\n"), HasSubstr("'x' after a face's vertex"));
  EXPECT_THAT(error(v + "f 1 2 99999999999999999999\n"), HasSubstr("is not an index"));
  EXPECT_EQ(error("v 0 zero 0\n"), "mesh.file:1: 'zero' is not a number");
  EXPECT_EQ(error("v 0 0\nv 1 2 3\n"), "mesh.file:1: a number is missing");
  EXPECT_EQ(error("v 0 0 1.5.2\n"), "mesh.file:1: '1.5.2' is not a number");
  EXPECT_EQ(error(v), "mesh.file: the file has no faces");
  EXPECT_EQ(error(""), "mesh.file: the file has no faces");
}

/// The sums of the areas of triangles in a plane of z, and of their values.
std::pair<double, double> areas(const MeshData& mesh) {
  double turned = 0, all = 0;
  for (const auto& corners : mesh.triangles) {
    const Vec3 normal = mesh.triangle(corners).normal;
    turned += normal.z / 2;
    all += length(normal) / 2;
  }
  return {turned, all};
}

/// One face with these corners.
MeshData polygon(const std::vector<Vec2>& corners) {
  std::string text, face = "f";
  for (size_t i = 0; i < corners.size(); ++i) {
    text += fmt::format("v {} {} 0\n", corners[i].x, corners[i].y);
    face += fmt::format(" {}", i + 1);
  }
  return read(text + face);
}

TEST(Obj, ConcavePolygonsAreCoveredOnce) {
  const std::vector<Vec2> arrow{{0, 0}, {2, -1}, {0, 2}, {-2, -1}};
  const std::vector<Vec2> corner{{1, -1}, {1, 0}, {0, 0}, {0, 1}, {-1, 1}, {-1, -1}};
  // A point on an edge, one that is repeated, and a hole that a bridge joins to the rim.
  const std::vector<Vec2> on_a_line{{1, -1}, {1, 0}, {0, 0},  {0, .5},
                                    {0, 1},  {0, 1}, {-1, 1}, {-1, -1}};
  const std::vector<Vec2> ring{{0, 0}, {3, 0}, {3, 3}, {0, 3}, {0, 0},
                               {1, 1}, {1, 2}, {2, 2}, {2, 1}, {1, 1}};
  const std::pair<std::vector<Vec2>, double> cases[] = {
      {arrow, 4}, {corner, 3}, {on_a_line, 3}, {ring, 8}};
  for (auto [corners, area] : cases)
    for (size_t first = 0; first < corners.size(); ++first) {
      std::rotate(corners.begin(), corners.begin() + 1, corners.end());
      const MeshData mesh = polygon(corners);
      EXPECT_EQ(mesh.triangles.size(), corners.size() - 2);
      const auto [turned, all] = areas(mesh);
      EXPECT_NEAR(turned, area, 1e-12);
      EXPECT_NEAR(all, area, 1e-12) << corners.size() << " corners from " << first;
    }
}

TEST(Obj, PolygonsThatCrossThemselvesKeepTheirArea) {
  Rng rng(7, Purpose::test, 0);
  for (int repeat = 0; repeat < 200; ++repeat) {
    std::vector<Vec2> corners;
    for (int i = 0; i < 3 + repeat / 10; ++i)  // on a coarse grid: many are repeated or collinear
      corners.emplace_back(std::floor(4 * rng.next()), std::floor(4 * rng.next()));
    double area = 0;
    for (size_t i = 2; i < corners.size(); ++i) {
      const Vec2 u = corners[i - 1] - corners[0], v = corners[i] - corners[0];
      area += (u.x * v.y - u.y * v.x) / 2;
    }
    const MeshData mesh = polygon(corners);
    EXPECT_EQ(mesh.triangles.size(), corners.size() - 2);
    EXPECT_NEAR(areas(mesh).first, area, 1e-12);
  }
}

TEST(Obj, StarsOfManyCornersAreRead) {
  std::vector<Vec2> corners;
  constexpr int count = 20000;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * pi * i / count, radius = i % 2 ? 2 : 1;
    corners.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  const auto [turned, all] = areas(polygon(corners));
  const double area =
      count * std::sin(2 * pi / count);  // of as many triangles, each of sides 1 and 2
  EXPECT_NEAR(turned, area, 1e-4);
  EXPECT_NEAR(all, area, 1e-4);
}

TEST(Obj, MarksAndLineEndsOfOtherSystems) {
  std::string old = square;
  old.erase(std::remove(old.begin(), old.end(), '\n'), old.end());
  for (const std::string& text : {"\xef\xbb\xbf" + square, old, "\xef\xbb\xbf" + old}) {
    const MeshData mesh = read(text);
    EXPECT_EQ(mesh.triangles.size(), 2u);
    EXPECT_EQ(mesh.uvs.at(3), Vec2f(0.5f, 0));
  }
  EXPECT_EQ(read("\xef\xbb\xbfv 1 2 3\nv 1 0 0\nv 1 1 0\nf 1 2 3").positions[0], Vec3f(1, 2, 3));
  EXPECT_THAT(error("# a\rv 0 0 0\rv 1 zero 0\r"), HasSubstr("mesh.file:3: 'zero'"));
}

TEST(Obj, SlashesMayStandBeforeNothing) {
  const std::string v = "v 0 0 0\nv 1 0 0\nv 1 1 0\nvt .5 1\nvn 0 1 0\n";
  const MeshData mesh = read(v + "f 1/1/ 2// 3/\nf 1/1/1 2/1/ 3//1\n");
  EXPECT_EQ(mesh.triangles.size(), 2u);
  EXPECT_EQ(mesh.positions.size(), 6u);
  EXPECT_EQ(mesh.uvs[0], Vec2f(.5f, 1));
  EXPECT_EQ(mesh.uvs[1], Vec2f(0));
  EXPECT_EQ(mesh.normals[0], Vec3f(0));
  EXPECT_EQ(mesh.normals[3], Vec3f(0, 1, 0));
  EXPECT_TRUE(read(v + "f 1// 2// 3//").normals.empty());
}

TEST(Obj, FacesOfFewCornersAreLeftOutAndCounted) {
  const MeshData mesh = read("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 9 9 9\nf 1 2\nf 1 2 3\nf 4 1\nf 2\n");
  EXPECT_EQ(mesh.triangles.size(), 1u);
  EXPECT_EQ(mesh.positions.size(), 3u);
  EXPECT_EQ(mesh.warnings,
            std::vector<std::string>{"3 faces are left out: fewer than three corners"});
}

TEST(Obj, NormalsAndUvsThatAreNoNumbersAreNotGiven) {
  const std::string v = "v 0 0 0\nv 1 0 0\nv 1 1 0\n";
  for (const char* bad :
       {"nan", "-nan(ind)", "-1.#IND", "1.#QNAN", "+1.#INF00", "-1.#IND00", "inf"}) {
    const std::string normal = fmt::format("vn {} 0 1\n", bad), uv = fmt::format("vt 1 {}\n", bad);
    MeshData mesh = read(v + normal + "vn 0 1 0\n" + uv + "vt 1 2\nf 1/1/1 2/2/2 3/2/2\n");
    EXPECT_EQ(mesh.normals.at(0), Vec3f(0)) << bad;
    EXPECT_EQ(mesh.normals.at(1), Vec3f(0, 1, 0));
    EXPECT_EQ(mesh.uvs.at(0), Vec2f(0));
    EXPECT_EQ(mesh.uvs.at(1), Vec2f(1, 2));
    mesh = read(v + normal + uv + "f 1/1/1 2/1/1 3/1/1\n");
    EXPECT_TRUE(mesh.normals.empty()) << bad;
    EXPECT_TRUE(mesh.uvs.empty());
  }
  // A position may be anything where no face uses it.
  EXPECT_EQ(read("v nan 0 0\n" + v + "f 2 3 4\n").positions.at(2), Vec3f(1, 1, 0));
}

TEST(Obj, TruncatedFilesAreSafe) { expect_truncations_are_safe(square, read); }

}  // namespace
}  // namespace mlt
