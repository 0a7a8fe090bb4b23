// Mitsuba's serialized meshes (Jakob 2010, Mitsuba documentation, sec. 8.1.8): several zlib streams
// behind each other, and a table of their offsets at the end of the file. Little endian throughout.
#include <zlib.h>

#include <algorithm>
#include <cstring>
#include <memory>

#include "base/atomic_file.h"
#include "scene/shape/common.h"
#include "scene/shape/readers.h"

namespace mlt {
namespace {

constexpr uint16_t magic = 0x041c;

enum Flag : uint32_t {
  has_normals = 0x0001,
  has_uvs = 0x0002,
  has_colors = 0x0008,
  face_normals = 0x0010,
  double_precision = 0x2000
};

template <class T>
T load(std::string_view bytes, size_t offset) {
  T value;
  std::memcpy(&value, bytes.data() + offset, sizeof(T));
  return value;
}

/// Offset of mesh number `index`. A file without the table may still hold one mesh.
size_t find_mesh(std::string_view bytes, int64_t index, const std::string& name) {
  const auto fail = [&](const std::string& message) { throw SceneError(at({name}, message)); };
  if (bytes.size() < 8 || load<uint16_t>(bytes, 0) != magic)
    fail("not a serialized mesh: it does not begin with the bytes 1c 04");
  if (index == 0) return 0;
  const size_t entry = load<uint16_t>(bytes, 2) == 3 ? 4 : 8;
  const uint32_t count = load<uint32_t>(bytes, bytes.size() - 4);
  if (count > (bytes.size() - 4) / entry) fail("the table at the end of the file is damaged");
  if (index < 0 || index >= count)
    fail(fmt::format("there is no mesh number {}; the file has {}, counted from 0", index, count));
  const size_t at = bytes.size() - 4 - entry * (count - static_cast<size_t>(index));
  const uint64_t offset = entry == 4 ? load<uint32_t>(bytes, at) : load<uint64_t>(bytes, at);
  if (offset > bytes.size() - 4 || load<uint16_t>(bytes, offset) != magic)
    fail(fmt::format("the table at the end of the file is damaged: no mesh begins at byte {}",
                     offset));
  return static_cast<size_t>(offset);
}

/// Decompresses a zlib stream.
class Inflater {
 public:
  Inflater(std::string_view bytes, const std::string& name) : name_(name) {
    stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    rest_ = bytes.size();
    if (inflateInit(&stream_) != Z_OK) fail("zlib does not start");
  }
  ~Inflater() { inflateEnd(&stream_); }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;

  void read(void* to, size_t size) {
    auto* out = static_cast<Bytef*>(to);
    while (size > 0) {
      const size_t step = std::min<size_t>(size, 1u << 30);
      stream_.next_out = out;
      stream_.avail_out = static_cast<uInt>(step);
      if (stream_.avail_in == 0) feed();
      const int result = inflate(&stream_, Z_NO_FLUSH);
      const size_t got = step - stream_.avail_out;
      out += got;
      size -= got;
      if (result == Z_STREAM_END && size > 0) fail("the mesh ends too early");
      if (result != Z_OK && result != Z_STREAM_END)
        fail(result == Z_BUF_ERROR ? "the file ends within a mesh"
                                   : "the compressed mesh is damaged");
    }
  }
  template <class T>
  T read() {
    T value;
    read(&value, sizeof(T));
    return value;
  }

  [[noreturn]] void fail(const std::string& message) const {
    throw SceneError(at({name_}, message));
  }

 private:
  void feed() {
    const size_t step = std::min<size_t>(rest_, 1u << 30);
    stream_.avail_in = static_cast<uInt>(step);
    rest_ -= step;
  }

  z_stream stream_{};
  size_t rest_;
  const std::string& name_;
};

/// Reads `count` items piece by piece, so that a wrong count cannot allocate more memory than the
/// file needs.
template <class Item, class Sink>
void read_items(Inflater& in, uint64_t count, Sink sink) {
  constexpr size_t piece = 1u << 14;
  std::vector<Item> buffer(static_cast<size_t>(std::min<uint64_t>(count, piece)));
  for (uint64_t done = 0; done < count; done += buffer.size()) {
    buffer.resize(static_cast<size_t>(std::min<uint64_t>(count - done, piece)));
    in.read(buffer.data(), buffer.size() * sizeof(Item));
    for (const Item& item : buffer) sink(item);
  }
}

template <class Real>
void read_vertices(Inflater& in, uint32_t flags, uint64_t count, MeshData& mesh) {
  using Triple = std::array<Real, 3>;
  using Pair = std::array<Real, 2>;
  read_items<Triple>(in, count, [&](const Triple& v) {
    const Vec3 p(v[0], v[1], v[2]);
    if (mesh.positions.empty()) mesh.origin = MeshData::origin_for(p);
    mesh.positions.push_back(p - mesh.origin);
  });
  if (flags & has_normals)
    read_items<Triple>(in, count,
                       [&](const Triple& v) { mesh.normals.push_back(Vec3(v[0], v[1], v[2])); });
  if (flags & has_uvs)
    read_items<Pair>(in, count, [&](const Pair& v) { mesh.uvs.push_back(Vec2(v[0], v[1])); });
  if (flags & has_colors) read_items<Triple>(in, count, [](const Triple&) {});
}

}  // namespace

SerializedMesh read_serialized(std::string_view bytes, int64_t index, const std::string& name) {
  const size_t begin = find_mesh(bytes, index, name);
  const auto version = load<uint16_t>(bytes, begin + 2);
  if (version != 3 && version != 4)
    throw SceneError(
        at({name}, "version {} of the serialized format is unknown; 3 and 4 are known", version));
  Inflater in(bytes.substr(begin + 4), name);
  const auto flags = in.read<uint32_t>();
  if (version == 4)
    while (in.read<char>() != '\0') {
    }  // The name of the mesh.
  const auto vertices = in.read<uint64_t>();
  const auto triangles = in.read<uint64_t>();
  if (vertices >= ~0u || triangles >= ~0u)
    in.fail("a mesh with 2^32 or more vertices or triangles");
  SerializedMesh result;
  result.face_normals = (flags & face_normals) != 0;
  if (flags & double_precision) {
    read_vertices<double>(in, flags, vertices, result.mesh);
  } else {
    read_vertices<float>(in, flags, vertices, result.mesh);
  }
  read_items<std::array<uint32_t, 3>>(
      in, triangles, [&](const auto& corners) { result.mesh.triangles.push_back(corners); });
  return result;
}

Plugin shape_serialized() {
  return {shape_schema("serialized", "A mesh from a Mitsuba .serialized file.",
                       concat({{filename_parameter("The .serialized file."),
                                {"shape_index", ParamType::integer, int64_t{0},
                                 "Which mesh of the file, counted from 0."}},
                               normals_parameters()})),
          [](Params& params) {
            const std::string path = params.text("filename");
            SerializedMesh read =
                read_serialized(read_file(path), params.integer("shape_index"), path);
            return mesh_from_file(params, std::move(read.mesh), read.face_normals);
          }};
}

}  // namespace mlt
