#include <cstring>

#include "scene/shape/readers.h"
#include "scene/shape_testing.h"

namespace mlt {
namespace {

using namespace shape_testing;

using testing::HasSubstr;

MeshData read(std::string_view text) { return read_ply(text, "mesh.file"); }
std::string error(std::string_view text) {
  return error_of([&] { read(text); });
}

/// Writes numbers as the three formats do.
class Writer {
 public:
  explicit Writer(const std::string& format) : format_(format) {}

  template <class T>
  Writer& put(T value) {
    if (format_ == "ascii") {
      bytes += std::to_string(+value) + " ";
      return *this;
    }
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    if (format_ == "binary_big_endian") std::reverse(raw, raw + sizeof(T));
    bytes.append(raw, sizeof(T));
    return *this;
  }
  Writer& end_line() {
    if (format_ == "ascii") bytes += "\n";
    return *this;
  }

  std::string bytes;

 private:
  std::string format_;
};

const std::string formats[] = {"ascii", "binary_little_endian", "binary_big_endian"};

/// A quad and a triangle, amid properties and elements that do not matter here.
std::string sample_file(const std::string& format) {
  std::string header = "ply\nformat " + format +
                       " 1.0\ncomment made by hand\nobj_info none\n"
                       "element material 2\nproperty list ushort double weights\nproperty char c\n"
                       "element vertex 5\nproperty double x\nproperty float y\nproperty short z\n"
                       "property uchar red\nproperty list uchar int tags\n"
                       "property float nx\nproperty float ny\nproperty float nz\n"
                       "property float s\nproperty float t\n"
                       "element face 2\nproperty float quality\n"
                       "property list uint8 uint32 vertex_indices\nproperty int group\n"
                       "end_header\n";
  Writer w(format);
  w.put<uint16_t>(2).put(1.5).put(-2.5).put<int8_t>(-1).end_line();
  w.put<uint16_t>(0).put<int8_t>(1).end_line();
  for (int i = 0; i < 5; ++i) {
    w.put(0.5 * i).put(0.25f * static_cast<float>(i)).put(static_cast<int16_t>(-i));
    w.put<uint8_t>(200).put<uint8_t>(1).put<int32_t>(7);
    w.put(0.f).put(0.f).put(1.f).put(0.125f).put(static_cast<float>(i)).end_line();
  }
  w.put(0.f).put<uint8_t>(4).put<uint32_t>(0).put<uint32_t>(1).put<uint32_t>(2).put<uint32_t>(3);
  w.put<int32_t>(-9).end_line();
  w.put(1.f).put<uint8_t>(3).put<uint32_t>(2).put<uint32_t>(3).put<uint32_t>(4);
  w.put<int32_t>(9).end_line();
  return header + w.bytes;
}

TEST(Ply, ReadsAllThreeFormatsAlike) {
  for (const std::string& format : formats) {
    SCOPED_TRACE(format);
    const MeshData mesh = read(sample_file(format));
    ASSERT_EQ(mesh.positions.size(), 5u);
    ASSERT_EQ(mesh.normals.size(), 5u);
    ASSERT_EQ(mesh.uvs.size(), 5u);
    EXPECT_EQ(mesh.positions[4], Vec3f(2, 1, -4));
    EXPECT_EQ(mesh.normals[2], Vec3f(0, 0, 1));
    EXPECT_EQ(mesh.uvs[3], Vec2f(0.125f, 3));
    const std::vector<std::array<uint32_t, 3>> expected{{0, 1, 2}, {0, 2, 3}, {2, 3, 4}};
    EXPECT_EQ(mesh.triangles, expected);
  }
}

TEST(Ply, ReadsAttributesOfVerticesAndFaces) {
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float flow_x\n"
      "property float flow_y\nproperty float flow_z\nproperty float y\nproperty float z\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty float heat\n"
      "element face 2\nproperty float my_weight_0\n"
      "property list uchar int vertex_indices\nproperty short k_0\nend_header\n";
  const MeshData mesh = read(header +
                             "0 .1 .2 .3 0 0 255 0 51 9\n1 .4 .5 .6 0 0 0 0 0 9\n"
                             "1 0 0 0 1 0 0 0 0 9\n0 0 0 0 1 0 0 0 0 9\n"
                             "0.5 4 0 1 2 3 7\n0.75 3 0 1 2 -8\n");
  ASSERT_EQ(mesh.attributes.size(), 4u);
  const MeshAttribute& flow = *mesh.find_attribute("vertex_flow");
  EXPECT_EQ(flow.channels, 3u);
  EXPECT_EQ(flow.values[4], 0.5f);
  EXPECT_FALSE(flow.on_faces);
  const MeshAttribute& colour = *mesh.find_attribute("vertex_color");
  EXPECT_EQ(colour.values[0], 1);
  EXPECT_EQ(colour.values[2], 0.2f);
  EXPECT_EQ(mesh.find_attribute("face_my_weight")->values, (std::vector<float>{0.5, 0.5, 0.75}));
  EXPECT_EQ(mesh.find_attribute("face_k")->values, (std::vector<float>{7, 7, -8}));
  EXPECT_TRUE(mesh.find_attribute("face_k")->on_faces);
  EXPECT_FALSE(mesh.find_attribute("vertex_heat"));
}

TEST(Ply, TruncatedFilesAreSafe) {
  for (const std::string& format : formats) expect_truncations_are_safe(sample_file(format), read);
}

TEST(Ply, TruncationIsAnError) {
  for (const std::string& format : formats) {
    std::string bytes = sample_file(format);
    bytes.resize(bytes.size() - 5);
    EXPECT_THAT(error(bytes), HasSubstr("the file ends within its element 'face'")) << format;
  }
}

std::string ascii(const std::string& vertex, const std::string& face, const std::string& body) {
  return "ply\r\nformat ascii 1.0\r\n" + vertex + face + "end_header\n" + body;
}
const std::string xyz = "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
const std::string one_face = "element face 1\nproperty list uchar int vertex_index\n";

TEST(Ply, TakesTextureCoordinatesUnderEitherName) {
  for (const char* names : {"u v", "s t", "texture_u texture_v"}) {
    const std::string n = names;
    const size_t blank = n.find(' ');
    const MeshData mesh = read(ascii(xyz + "property float " + n.substr(0, blank) +
                                         "\nproperty float " + n.substr(blank + 1) + "\n",
                                     one_face, "0 0 0 1 2\n1 0 0 3 4\n0 1 0 5 6\n3 0 1 2\n"));
    ASSERT_EQ(mesh.uvs.size(), 3u) << names;
    EXPECT_EQ(mesh.uvs[2], Vec2f(5, 6));
  }
}

TEST(Ply, FacesMayComeFirst) {
  const MeshData mesh = read(ascii("", one_face + xyz, "3 0 1 2\n0 0 0\n1 0 0\n0 1 0\n"));
  EXPECT_EQ(mesh.triangles.size(), 1u);
  EXPECT_EQ(mesh.positions[2], Vec3f(0, 1, 0));
}

const std::string six = "element vertex 6\nproperty float x\nproperty float y\nproperty float z\n";
const std::string six_corners = "1 0 -1\n1 0 0\n0 0 0\n0 0 1\n-1 0 1\n-1 0 -1\n";

TEST(Ply, ConcavePolygonsAreCoveredOnce) {
  const std::string face = "6 0 1 2 3 4 5\n";
  for (const MeshData& mesh : {read(ascii(six, one_face, six_corners + face)),
                               read(ascii("", one_face + six, face + six_corners))}) {
    double area = 0;
    for (const auto& corners : mesh.triangles) area += length(mesh.triangle(corners).normal) / 2;
    EXPECT_EQ(mesh.triangles.size(), 4u);
    EXPECT_NEAR(area, 3, 1e-12);
  }
  // The corner does not exist: check_mesh says so.
  EXPECT_EQ(read(ascii(six, one_face, six_corners + "6 0 1 2 3 4 9\n")).triangles.size(), 4u);
}

TEST(Ply, FacesOfFewCornersAreLeftOutAndCounted) {
  const MeshData mesh = read(ascii(xyz,
                                   "element face 2\nproperty list uchar int vertex_index\n"
                                   "property float face_a\n",
                                   "0 0 0\n1 0 0\n0 1 0\n2 0 1 5\n3 0 1 2 7\n"));
  EXPECT_EQ(mesh.triangles.size(), 1u);
  EXPECT_EQ(mesh.attributes.at(0).values, std::vector<float>{7});
  EXPECT_EQ(mesh.warnings.size(), 1u);
}

TEST(Ply, StripsTurnTheOtherWayEachTime) {
  using Triangle = std::array<uint32_t, 3>;
  const std::string strips = "element tristrips 1\nproperty list int int vertex_indices\n";
  const MeshData mesh = read(ascii(six, strips, six_corners + "11 0 1 2 3 -1 3 4 5 5 2 -1\n"));
  EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {2, 1, 3}, {3, 4, 5}}));
  EXPECT_THAT(error(ascii(six, strips, six_corners + "3 0 1 -2\n")), HasSubstr("vertex -2"));
}

TEST(Ply, MarksAndLineEndsOfOtherSystems) {
  std::string text = ascii(xyz, one_face, "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  EXPECT_EQ(read("\xef\xbb\xbf" + text).positions.at(2), Vec3f(0, 1, 0));
  std::replace(text.begin(), text.end(), '\n', '\r');
  EXPECT_EQ(read(text).positions.at(2), Vec3f(0, 1, 0));
  // The first byte of the numbers looks like the end of a line.
  std::string header =
      "ply\nformat binary_little_endian 1.0\nelement face 1\nproperty list uchar int vertex_index\n"
      "property uchar x\nelement vertex 10\nproperty uchar x\nproperty uchar y\nproperty uchar z\n"
      "end_header\n";
  std::replace(header.begin(), header.end(), '\n', '\r');
  std::string body(1, '\n');
  for (char i = 0; i < 10; ++i) body += std::string{i, 0, 0, 0};
  body += '\0' + std::string(30, 'a');
  EXPECT_EQ(read(header + body).triangles.size(), 8u);
}

TEST(Ply, LyingCountsAreRefusedBeforeMemoryIsTaken) {
  for (const std::string& format : formats) {
    const std::string head = "ply\nformat " + format + " 1.0\n";
    const std::string many =
        "element vertex 4000000000\nproperty float x\nproperty float y\nproperty float z\n";
    EXPECT_THAT(error(head + many + one_face + "end_header\n0 0 0\n"),
                HasSubstr("the file ends within its element 'vertex'"));
    EXPECT_THAT(error(head + "element face 9000000000000000000\n"
                             "property list uchar int vertex_index\nend_header\n3 0 1 2\n"),
                HasSubstr("the file ends within its element 'face'"));
    EXPECT_THAT(error(head + "element junk 9000000000000000000\nproperty list int double a\n"
                             "end_header\n\x7f\x7f\x7f\x7f"),
                HasSubstr("the file ends within its element 'junk'"));
    // Without properties an element takes no bytes, however many there are.
    EXPECT_THAT(error(head + "element junk 9000000000000000000\nend_header\n"),
                HasSubstr("no element 'vertex'"));
  }
}

TEST(Ply, SaysWhatIsWrongAndWhere) {
  const std::string body = "0 0 0\n1 0 0\n0 1 0\n";
  EXPECT_EQ(error(ascii(xyz, one_face, "0 0 0\n1 zero 0\n0 1 0\n3 0 1 2\n")),
            "mesh.file:11: 'zero' is not a number");
  EXPECT_THAT(error(ascii(xyz, one_face, body + "2 0 1\n")), HasSubstr("no faces"));
  EXPECT_THAT(error(ascii(xyz, one_face, body + "3 0 1 -2\n")), HasSubstr("vertex -2"));
  EXPECT_THAT(error(ascii(xyz, one_face, body + "-3 0 1 2\n")), HasSubstr("negative length"));
  EXPECT_THAT(error(ascii(xyz, "", body)), HasSubstr("no faces"));
  EXPECT_THAT(error(ascii("", one_face, "3 0 1 2\n")), HasSubstr("no element 'vertex'"));
  EXPECT_THAT(error(ascii(xyz + xyz, one_face, body + body + "3 0 1 2\n")),
              HasSubstr("two elements 'vertex'"));
  EXPECT_THAT(error(ascii("element vertex 0\nproperty float x\nproperty float y\n", one_face, "")),
              HasSubstr("needs the properties x, y and z"));
  EXPECT_THAT(error(ascii(xyz, "element face 1\nproperty int vertex_index\n", body + "3\n")),
              HasSubstr("needs a list property 'vertex_indices'"));
  EXPECT_THAT(
      error(ascii(xyz, "element face 1\nproperty list uchar float vertex_index\n", body + "3\n")),
      HasSubstr("must be integers"));
}

TEST(Ply, SaysWhatIsWrongInTheHeader) {
  EXPECT_EQ(error(""), "mesh.file:1: not a PLY file: it does not begin with 'ply'");
  EXPECT_THAT(error("plyx\n"), HasSubstr("not a PLY file"));
  EXPECT_THAT(error("ply\nformat ascii 1.0\n"), HasSubstr("'end_header' is missing"));
  EXPECT_THAT(error("ply\nend_header\n"), HasSubstr("no 'format' line"));
  EXPECT_EQ(error("ply\nformat text 1.0\n"),
            "mesh.file:2: unknown PLY format 'text'; valid are: ascii, binary_little_endian, "
            "binary_big_endian");
  EXPECT_THAT(error("ply\nformat ascii 2.0\n"), HasSubstr("version '2.0'"));
  EXPECT_THAT(error("ply\nformat ascii 1.0\nproperty int x\n"), HasSubstr("before the first"));
  EXPECT_THAT(error("ply\nelement vertex many\n"), HasSubstr("'many' is not a count"));
  EXPECT_THAT(error("ply\nelement vertex -1\n"), HasSubstr("negative count"));
  EXPECT_THAT(error("ply\nelement vertex 1\nproperty half x\n"), HasSubstr("PLY type 'half'"));
  EXPECT_THAT(error("ply\nelement face 1\nproperty list float int i\n"),
              HasSubstr("must be an integer"));
  EXPECT_THAT(error("ply\nelement vertex 1\nproperty int x y\n"), HasSubstr("'y' is too much"));
  EXPECT_THAT(error("ply\nelements vertex 1\n"), HasSubstr("unknown line 'elements'"));
}

}  // namespace
}  // namespace mlt
