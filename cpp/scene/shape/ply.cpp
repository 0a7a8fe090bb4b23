// The elements of a PLY file that make a mesh: positions, normals and texture coordinates of
// `vertex`, the index lists of `face` and `tristrips`, and attributes of the first two. Everything
// else is passed over.
#include "scene/shape/common.h"
#include "scene/shape/ply_attributes.h"
#include "scene/shape/ply_source.h"
#include "scene/shape/polygons.h"
#include "scene/shape/readers.h"

#include <algorithm>
#include <limits>

namespace mlt {
namespace {

template <class Source>
class PlyBody {
 public:
  explicit PlyBody(Source source) : source_(std::move(source)) {}

  MeshData read(const PlyHeader& header) {
    bool vertices = false, faces = false, strips = false;
    for (const PlyElement& element : header.elements) {
      source_.expect(element.count, source_.least_size(element), element.name);
      if (element.name == "vertex") {
        if (vertices) source_.fail("the PLY header has two elements 'vertex'");
        vertices = true;
        read_vertices(element);
      } else if (element.name == "face") {
        if (faces) source_.fail("the PLY header has two elements 'face'");
        faces = true;
        read_faces(element);
      } else if (element.name == "tristrips") {
        strips = true;
        read_strips(element);
      } else if (!element.properties.empty()) {
        for (uint64_t i = 0; i < element.count; ++i)
          for (const PlyProperty& property : element.properties) skip_property(element, property);
      }
    }
    if (!vertices) source_.fail("the PLY file has no element 'vertex'");
    if (mesh_.triangles.empty()) source_.fail("the PLY file has no faces");
    if (strips) drop_face_attributes();
    triangulate(mesh_, fans_);
    warn_of_short_faces(mesh_, short_faces_);
    return std::move(mesh_);
  }

 private:
  /// The destinations of the numbers of a vertex.
  enum Slot { x, y, z, nx, ny, nz, u, v, slot_count };

  void read_vertices(const PlyElement& element) {
    if (element.count >= std::numeric_limits<uint32_t>::max()) source_.fail("too many vertices");
    const std::vector<int> slots = slots_of(element);
    const bool normals = has(slots, nx) && has(slots, ny) && has(slots, nz);
    const bool uvs = has(slots, u) && has(slots, v);
    if (!has(slots, x) || !has(slots, y) || !has(slots, z))
      source_.fail("the element 'vertex' needs the properties x, y and z");
    const size_t count = static_cast<size_t>(element.count);
    mesh_.positions.resize(count);
    if (normals) mesh_.normals.resize(count);
    if (uvs) mesh_.uvs.resize(count);
    PlyAttributes attributes(element, "vertex_");
    double value[slot_count] = {};
    for (size_t i = 0; i < count; ++i) {
      for (size_t k = 0; k < slots.size(); ++k) {
        if (slots[k] == slot_count)
          read_other(element, k, attributes);
        else
          value[slots[k]] = source_.real(element.properties[k].type, element.name);
      }
      attributes.end_row(1);
      const Vec3 p(value[x], value[y], value[z]);
      if (i == 0) mesh_.origin = MeshData::origin_for(p);
      mesh_.positions[i] = p - mesh_.origin;
      if (normals) mesh_.normals[i] = Vec3(value[nx], value[ny], value[nz]);
      if (uvs) mesh_.uvs[i] = Vec2(value[u], value[v]);
    }
    keep(attributes);
  }

  void keep(const PlyAttributes& read) {
    const auto& all = read.attributes();
    mesh_.attributes.insert(mesh_.attributes.end(), all.begin(), all.end());
  }

  static bool has(const std::vector<int>& slots, Slot slot) {
    return std::find(slots.begin(), slots.end(), slot) != slots.end();
  }

  /// The slot of each property; slot_count if it is ignored.
  static std::vector<int> slots_of(const PlyElement& element) {
    std::vector<int> slots(element.properties.size(), slot_count);
    const auto assign = [&](Slot slot, std::initializer_list<const char*> names) {
      const int found = element.find(names);
      if (found >= 0 && !element.properties[static_cast<size_t>(found)].list)
        slots[static_cast<size_t>(found)] = slot;
    };
    assign(x, {"x"});
    assign(y, {"y"});
    assign(z, {"z"});
    assign(nx, {"nx"});
    assign(ny, {"ny"});
    assign(nz, {"nz"});
    assign(u, {"u", "s", "texture_u"});
    assign(v, {"v", "t", "texture_v"});
    return slots;
  }

  /// The property of an element that lists vertices.
  int list_of_vertices(const PlyElement& element) const {
    const int list = element.find({"vertex_indices", "vertex_index"});
    if (list < 0 || !element.properties[static_cast<size_t>(list)].list)
      source_.fail("the element '" + element.name + "' needs a list property 'vertex_indices'");
    if (!is_integer(element.properties[static_cast<size_t>(list)].type))
      source_.fail("'vertex_indices' must be integers");
    return list;
  }

  void read_faces(const PlyElement& element) {
    const int list = list_of_vertices(element);
    mesh_.triangles.reserve(static_cast<size_t>(element.count));
    PlyAttributes attributes(element, "face_");
    for (uint64_t i = 0; i < element.count; ++i) {
      const size_t before = mesh_.triangles.size();
      for (size_t k = 0; k < element.properties.size(); ++k) {
        if (static_cast<int>(k) == list)
          read_polygon(element, element.properties[k]);
        else
          read_other(element, k, attributes);
      }
      attributes.end_row(mesh_.triangles.size() - before);
    }
    keep(attributes);
  }

  /// Reads a property of an attribute, or one that is ignored.
  void read_other(const PlyElement& element, size_t index, PlyAttributes& attributes) {
    const PlyProperty& property = element.properties[index];
    if (attributes.takes(index))
      attributes.put(index, source_.real(property.type, element.name));
    else
      skip_property(element, property);
  }

  void skip_property(const PlyElement& element, const PlyProperty& property) {
    source_.skip(property.type, property.list ? read_count(element, property) : 1, element.name);
  }

  uint64_t read_count(const PlyElement& element, const PlyProperty& property) {
    const int64_t count = source_.integer(property.count_type, element.name);
    if (count < 0) source_.fail("a list of negative length in the element '" + element.name + "'");
    return static_cast<uint64_t>(count);
  }

  void read_polygon(const PlyElement& element, const PlyProperty& property) {
    const uint64_t count = read_count(element, property);
    if (count < 3) {
      ++short_faces_;
      return source_.skip(property.type, count, element.name);
    }
    if (count > 3) fans_.push_back({mesh_.triangles.size(), static_cast<size_t>(count - 2)});
    const uint32_t first = read_index(element, property);
    uint32_t previous = read_index(element, property);
    for (uint64_t i = 2; i < count; ++i) {
      const uint32_t next = read_index(element, property);
      mesh_.triangles.push_back({first, previous, next});
      previous = next;
    }
  }

  /// Strips of triangles, of which every other one turns the other way; -1 begins a new strip.
  void read_strips(const PlyElement& element) {
    const int list = list_of_vertices(element);
    for (uint64_t i = 0; i < element.count; ++i)
      for (size_t k = 0; k < element.properties.size(); ++k) {
        if (static_cast<int>(k) == list)
          read_strip(element, element.properties[k]);
        else
          skip_property(element, element.properties[k]);
      }
  }

  void read_strip(const PlyElement& element, const PlyProperty& property) {
    uint32_t before = 0, previous = 0;
    uint64_t length = 0;
    for (uint64_t left = read_count(element, property); left > 0; --left) {
      const int64_t index = source_.integer(property.type, element.name);
      if (index == -1) {
        length = 0;
        continue;
      }
      const uint32_t next = checked_index(index);
      if (++length >= 3 && before != previous && previous != next && next != before) {
        const bool even = length % 2 == 1;
        mesh_.triangles.push_back({even ? before : previous, even ? previous : before, next});
      }
      before = previous;
      previous = next;
    }
  }

  /// Strips have none, and each triangle would need one.
  void drop_face_attributes() {
    auto& all = mesh_.attributes;
    all.erase(std::remove_if(all.begin(), all.end(), [](const auto& a) { return a.on_faces; }),
              all.end());
  }

  uint32_t read_index(const PlyElement& element, const PlyProperty& property) {
    return checked_index(source_.integer(property.type, element.name));
  }
  /// check_mesh checks whether the vertex exists: vertices may follow the faces.
  uint32_t checked_index(int64_t index) const {
    if (index < 0 || index >= std::numeric_limits<uint32_t>::max())
      source_.fail("a face names vertex " + std::to_string(index) + ", which cannot exist");
    return static_cast<uint32_t>(index);
  }

  Source source_;
  std::vector<Fan> fans_;
  size_t short_faces_ = 0;
  MeshData mesh_;
};

}  // namespace

MeshData read_ply(std::string_view bytes, const std::string& name) {
  const PlyHeader header = read_ply_header(bytes, name);
  const std::string_view body = bytes.substr(header.size);
  switch (header.format) {
    case PlyFormat::ascii: return PlyBody(AsciiSource(body, name, header.lines + 1)).read(header);
    case PlyFormat::little_endian: return PlyBody(BinarySource<false>(body, name)).read(header);
    case PlyFormat::big_endian: break;
  }
  return PlyBody(BinarySource<true>(body, name)).read(header);
}

Plugin shape_ply() {
  return mesh_file_plugin("ply", "A mesh from a PLY (Stanford triangle format) file.",
                          "The PLY file.", false,
                          [](std::string_view bytes, const std::string& name, Params&) {
                            return read_ply(bytes, name);
                          });
}

}  // namespace mlt
