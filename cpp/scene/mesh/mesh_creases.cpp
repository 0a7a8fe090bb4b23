// Smooth normals with creases, as mesh_data.h describes them.
#include "scene/mesh/mesh_data.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace mlt {
namespace {

/// The corners of all triangles, sorted so that those with equal position and uv are adjacent.
std::vector<uint32_t> corners_by_place(const MeshData& data) {
  const auto place = [&](uint32_t corner) {
    const uint32_t vertex = data.triangles[corner / 3][corner % 3];
    const Vec3f& p = data.positions[vertex];
    const Vec2f uv = data.uvs.empty() ? Vec2f(0) : data.uvs[vertex];
    return std::make_tuple(p.x, p.y, p.z, uv.x, uv.y);
  };
  std::vector<uint32_t> corners(3 * data.triangles.size());
  std::iota(corners.begin(), corners.end(), 0u);
  std::sort(corners.begin(), corners.end(), [&](uint32_t a, uint32_t b) {
    return std::make_pair(place(a), a) < std::make_pair(place(b), b);
  });
  return corners;
}

/// Renumbers the vertices of a mesh, of which some are duplicated.
class Renumbering {
 public:
  explicit Renumbering(const MeshData& data) : data_(data), triangles_(data.triangles) {}

  /// Adds a copy of the vertex of this corner.
  uint32_t copy(uint32_t corner) {
    sources_.push_back(data_.triangles[corner / 3][corner % 3]);
    return static_cast<uint32_t>(sources_.size() - 1);
  }
  void set(uint32_t corner, uint32_t vertex) { triangles_[corner / 3][corner % 3] = vertex; }

  void apply(MeshData& data) {
    gather(data.positions, 1);
    if (!data.uvs.empty()) gather(data.uvs, 1);
    data.normals = {};
    for (MeshAttribute& attribute : data.attributes)
      if (!attribute.on_faces) gather(attribute.values, attribute.channels);
    data.triangles = std::move(triangles_);
  }

 private:
  template <class T>
  void gather(std::vector<T>& values, size_t each) const {
    std::vector<T> gathered;
    gathered.reserve(sources_.size() * each);
    for (const uint32_t source : sources_)
      for (size_t k = 0; k < each; ++k) gathered.push_back(values[source * each + k]);
    values = std::move(gathered);
  }

  const MeshData& data_;
  std::vector<std::array<uint32_t, 3>> triangles_;
  std::vector<uint32_t> sources_;
};

}  // namespace

void add_creased_normals(MeshData& data, double angle) {
  std::vector<Vec3> normals;
  for (const auto& corners : data.triangles) {
    const Vec3 normal = data.triangle(corners).normal;
    const double l2 = length_squared(normal);
    normals.push_back(l2 > 0 ? normal / std::sqrt(l2) : Vec3(0));
  }
  const double least = std::cos(angle * pi / 180);
  const auto vertex_of = [&](uint32_t corner) { return data.triangles[corner / 3][corner % 3]; };
  const auto same_place = [&](uint32_t a, uint32_t b) {
    const uint32_t i = vertex_of(a), j = vertex_of(b);
    return data.positions[i] == data.positions[j] &&
           (data.uvs.empty() || data.uvs[i] == data.uvs[j]);
  };
  Renumbering numbers(data);
  std::vector<uint32_t> left = corners_by_place(data), others;
  for (size_t begin = 0, end = 0; begin < left.size(); begin = end) {
    while (end < left.size() && same_place(left[begin], left[end])) ++end;
    std::vector<uint32_t> group(left.begin() + static_cast<std::ptrdiff_t>(begin),
                                left.begin() + static_cast<std::ptrdiff_t>(end));
    while (!group.empty()) {
      const Vec3 first = normals[group.front() / 3];
      const uint32_t vertex = numbers.copy(group.front());
      others.clear();
      for (const uint32_t corner : group) {
        const bool flat = corner == group.front() || dot(first, normals[corner / 3]) > least;
        if (flat)
          numbers.set(corner, vertex);
        else
          others.push_back(corner);
      }
      group.swap(others);
    }
  }
  numbers.apply(data);
  add_smooth_normals(data);
}

}  // namespace mlt
