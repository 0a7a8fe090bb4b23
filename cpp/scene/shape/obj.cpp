// Wavefront OBJ (Alias|Wavefront, "Advanced Visualizer" manual, appendix B1): v, vt, vn, f, and
// usemtl where one material is asked for. Libraries of materials, groups, smoothing groups, lines,
// points and free-form elements are ignored.
#include "base/rng.h"
#include "scene/shape/common.h"
#include "scene/shape/polygons.h"
#include "scene/shape/readers.h"
#include "scene/shape/text_scanner.h"

#include <map>
#include <optional>

namespace mlt {
namespace {

constexpr uint32_t none = ~0u;

/// Indices of one corner of a face: position, texture coordinate (or none), normal (or none).
struct Corner {
  uint32_t position, uv, normal;
  bool operator==(const Corner& o) const {
    return position == o.position && uv == o.uv && normal == o.normal;
  }
};

/// Numbers distinct corners in the order of their appearance. The first corner of each position is
/// found by the position alone, which keeps memory accesses local; the others are in a hash table
/// with open addressing.
class CornerTable {
 public:
  uint32_t number_of(const Corner& corner) {
    if (corner.position >= first_.size()) first_.resize(size_t{corner.position} + 1, none);
    uint32_t& first = first_[corner.position];
    if (first == none) return first = append(corner);
    if (corners_[first] == corner) return first;
    if (2 * (others_ + 1) > slots_.size()) grow();
    uint32_t& slot = slots_[find(corner)];
    if (slot == none) {
      slot = append(corner);
      ++others_;
    }
    return slot;
  }
  const std::vector<Corner>& corners() const { return corners_; }

 private:
  uint32_t append(const Corner& corner) {
    corners_.push_back(corner);
    return static_cast<uint32_t>(corners_.size() - 1);
  }
  size_t find(const Corner& corner) const {
    const size_t mask = slots_.size() - 1;
    size_t i = mix_bits(corner.position + (uint64_t{corner.uv} << 32) +
                        corner.normal * 0x9e3779b97f4a7c15u) &
               mask;
    while (slots_[i] != none && !(corners_[slots_[i]] == corner)) i = (i + 1) & mask;
    return i;
  }
  void grow() {
    const std::vector<uint32_t> old = std::move(slots_);
    slots_.assign(std::max<size_t>(1024, 4 * old.size()), none);
    for (const uint32_t number : old)
      if (number != none) slots_[find(corners_[number])] = number;
  }

  std::vector<Corner> corners_;
  std::vector<uint32_t> first_, slots_;
  size_t others_ = 0;  ///< Corners in the hash table.
};

class ObjReader {
 public:
  ObjReader(std::string_view bytes, const std::string& name,
            const std::optional<std::string>& material)
      : text_(bytes, name),
        name_(name),
        material_(material),
        is_wanted_(!material || material->empty()) {}

  MeshData read() {
    for (; !text_.at_end(); text_.next_line()) {
      text_.skip_blanks();
      if (!text_.at_line_end()) read_statement();
    }
    if (mesh_.triangles.empty()) throw SceneError(at({name_}, "the file has no faces"));
    gather();
    triangulate(mesh_, fans_);
    warn_of_short_faces(mesh_, short_faces_);
    return std::move(mesh_);
  }

 private:
  void read_statement() {
    const std::string_view keyword = text_.word();
    if (keyword == "v") {
      read_position();
    } else if (keyword == "vt") {
      uvs_.push_back(read_uv());
    } else if (keyword == "vn") {
      normals_.push_back(read_triple());
    } else if (keyword == "f") {
      if (is_wanted_) read_face();
    } else if (keyword == "usemtl" && material_) {
      is_wanted_ = text_.rest_of_line() == *material_;
    }
  }

  double number() {
    text_.skip_blanks();
    return text_.real_or_nan("a number");
  }

  void read_position() {
    const Vec3 p = read_triple();
    if (is_finite(p) && positions_.size() == bad_positions_.size())
      mesh_.origin = MeshData::origin_for(p);
    positions_.push_back(p - mesh_.origin);
    if (!is_finite(Vec3(positions_.back())))
      bad_positions_[static_cast<uint32_t>(positions_.size() - 1)] = text_.line();
  }

  Vec3 read_triple() {
    const double x = number(), y = number(), z = number();
    return Vec3(x, y, z);
  }

  Vec2f read_uv() {
    const double u = number();
    text_.skip_blanks();
    return Vec2(u, text_.at_line_end() ? 0 : number());
  }

  void read_face() {
    face_.clear();
    for (text_.skip_blanks(); !text_.at_line_end(); text_.skip_blanks())
      face_.push_back(read_corner());
    if (face_.size() < 3) {
      ++short_faces_;
      return;
    }
    if (face_.size() > 3) fans_.push_back({mesh_.triangles.size(), face_.size() - 2});
    const uint32_t first = table_.number_of(face_[0]);
    uint32_t previous = table_.number_of(face_[1]);
    for (size_t i = 2; i < face_.size(); ++i) {
      const uint32_t vertex = table_.number_of(face_[i]);
      mesh_.triangles.push_back({first, previous, vertex});
      previous = vertex;
    }
  }

  /// Reads a corner: "p", "p/t", "p//n" or "p/t/n"; after a slash there may be nothing.
  Corner read_corner() {
    Corner corner{index(positions_.size(), "vertex"), none, none};
    if (const auto bad = bad_positions_.find(corner.position); bad != bad_positions_.end())
      throw SceneError(
          at({name_, bad->second},
             "the position of a vertex that a face uses is not finite (in single precision)"));
    if (text_.accept('/')) {
      if (!text_.is_at('/')) corner.uv = index_if_any(uvs_.size(), "texture coordinate");
      if (text_.accept('/')) corner.normal = index_if_any(normals_.size(), "normal");
    }
    const std::string_view rest = text_.word();
    if (!rest.empty())
      text_.fail("'" + std::string(rest.substr(0, 40)) + "' after a face's vertex");
    // What is no number is not given.
    if (corner.uv != none && !is_finite(Vec2(uvs_[corner.uv]))) corner.uv = none;
    if (corner.normal != none && !is_finite(Vec3(normals_[corner.normal]))) corner.normal = none;
    return corner;
  }

  uint32_t index_if_any(size_t count, const char* what) {
    return text_.at_word_end() ? none : index(count, what);
  }

  /// Reads an index, which is counted from 1, or from the end if negative.
  uint32_t index(size_t count, const char* what) {
    const int64_t given = text_.integer("an index");
    const int64_t counted = given < 0 ? given + static_cast<int64_t>(count) : given - 1;
    if (counted < 0 || counted >= static_cast<int64_t>(count) || counted >= none)
      text_.fail(
          fmt::format("a face names {} {}, but {} are defined above it", what, given, count));
    return static_cast<uint32_t>(counted);
  }

  void gather() {
    const std::vector<Corner>& corners = table_.corners();
    bool any_uv = false, any_normal = false;
    for (const Corner& c : corners) {
      any_uv = any_uv || c.uv != none;
      any_normal = any_normal || c.normal != none;
    }
    mesh_.positions.reserve(corners.size());
    for (const Corner& c : corners) mesh_.positions.push_back(positions_[c.position]);
    if (any_uv)
      for (const Corner& c : corners) mesh_.uvs.push_back(c.uv == none ? Vec2f(0) : uvs_[c.uv]);
    if (any_normal)
      for (const Corner& c : corners)
        mesh_.normals.push_back(c.normal == none ? Vec3f(0) : normals_[c.normal]);
  }

  TextScanner text_;
  const std::string& name_;
  std::optional<std::string> material_;  ///< Faces of others are left out.
  bool is_wanted_;                       ///< Whether the material is that of the next faces.
  std::vector<Vec3f> positions_, normals_;
  std::vector<Vec2f> uvs_;
  std::map<uint32_t, int> bad_positions_;  ///< Lines of positions that are not finite.
  std::vector<Corner> face_;
  std::vector<Fan> fans_;
  size_t short_faces_ = 0;
  CornerTable table_;
  MeshData mesh_;
};

}  // namespace

MeshData read_obj(std::string_view bytes, const std::string& name,
                  const std::optional<std::string>& material) {
  return ObjReader(bytes, name, material).read();
}

Plugin shape_obj() {
  return mesh_file_plugin(
      "obj", "A mesh from a Wavefront OBJ file.", "The OBJ file.", true,
      [](std::string_view bytes, const std::string& name, Params& params) {
        std::optional<std::string> material;
        if (params.has("usemtl")) material = params.text("usemtl");
        return read_obj(bytes, name, material);
      },
      {{"usemtl", ParamType::text, no_default,
        "Of the faces, those of this material alone; empty: those before the first `usemtl`."}});
}

}  // namespace mlt
