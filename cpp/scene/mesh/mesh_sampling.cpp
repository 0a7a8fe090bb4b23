// Positions on a mesh that emits light: evenly over its area or, for next-event estimation, on a
// triangle that a tree of them chooses by the point.
#include "base/error.h"
#include "scene/mesh/mesh.h"

namespace mlt {
namespace {

/// Up to this number of triangles all points choose by area.
constexpr size_t few_triangles = 2;

}  // namespace

void Mesh::prepare_sampling() {
  if (!triangle_areas_.empty()) return;
  if (!(area_ > 0)) throw SceneError(at(where, "a mesh without area cannot emit light"));
  std::vector<double> areas(data_->triangles.size());
  for (uint32_t i = 0; i < areas.size(); ++i)
    areas[i] = length(data_->triangle(triangles_[i]).normal);
  triangle_areas_ = Discrete(areas);
  if (areas.size() <= few_triangles) return;
  std::vector<LightBounds> bounds;
  for (uint32_t i = 0; i < areas.size(); ++i) bounds.push_back(bounds_of(i));
  triangle_tree_ = LightTree(bounds);
}

std::optional<Vec3> Mesh::bright_side(uint32_t triangle) const {
  const Vec3 ng = record(triangle).ng;
  if (!has_normals()) return ng;
  int turned = 0;
  for (const Vec2f& corner : {Vec2f(0, 0), Vec2f(1, 0), Vec2f(0, 1)})
    turned += dot(normal_sum(triangle, corner), Vec3f(ng)) < 0;
  if (turned == 0) return ng;
  return turned == 3 ? std::optional<Vec3>(-ng) : std::nullopt;
}

LightBounds Mesh::bounds_of(uint32_t triangle) const {
  const TriangleRecord& record = records_[triangle];
  LightBounds bounds;
  for (const Vec3f& p : {record.p0, record.p1, record.p2}) {
    bounds.low = glm::min(bounds.low, Vec3(p));
    bounds.high = glm::max(bounds.high, Vec3(p));
  }
  if (const auto normal = bright_side(triangle)) {
    bounds.axis = *normal;
    bounds.cos_normals = 1;
  }
  bounds.cos_emission = 0;
  bounds.power = area_of(triangle);
  return bounds;
}

PositionSample Mesh::position(const Barycentrics& point) const {
  const auto& [index, b, per_pdf] = point;
  const Edges tri = records_[index].edges();
  PositionSample sample;
  sample.at.p = tri.p0 + tri.e1 * b.x + tri.e2 * b.y;
  fill(tri, index, b.x, b.y, sample.at);
  sample.pdf = 1 / per_pdf;
  return sample;
}

Mesh::Barycentrics Mesh::sample_barycentrics_for(const Vec3& from, const Vec2& u) const {
  if (!chooses_by_point()) return sample_barycentrics(u);
  const LightTree::Choice chosen = triangle_tree_.sample(from, u.x);
  return {chosen.light, sample_triangle({chosen.remainder, u.y}),
          area_of(chosen.light) / chosen.probability};
}

PositionSample Mesh::sample_direct(const Vec3& from, const Vec2& u) const {
  return position(sample_barycentrics_for(from, u));
}

double Mesh::direct_density(uint32_t triangle, const Vec3& from) const {
  if (!chooses_by_point()) return 1 / area_;
  return triangle_tree_.probability(triangle, from) / area_of(triangle);
}

Vec2 Mesh::barycentrics(const SurfacePoint& at) const {
  const Edges tri = records_[at.primitive].edges();
  const Vec3 q = at.p - tri.p0, normal = cross(tri.e1, tri.e2);
  const double scale = 1 / length_squared(normal);
  return {dot(cross(q, tri.e2), normal) * scale, dot(cross(tri.e1, q), normal) * scale};
}

/// The numbers for this point on its triangle.
Vec2 Mesh::invert_in_triangle(const SurfacePoint& at) const {
  const Vec2 u = invert_triangle(barycentrics(at));
  const auto clamp = [](double x) { return std::min(std::max(x, 0.0), 1 - 0x1p-53); };
  return {clamp(u.x), clamp(u.y)};
}

Vec2 Mesh::invert_position(const SurfacePoint& at) const {
  const Vec2 u = invert_in_triangle(at);
  return {triangle_areas_.invert(at.primitive, u.x), u.y};
}

Vec2 Mesh::invert_direct(const Vec3& from, const SurfacePoint& at) const {
  if (!chooses_by_point()) return invert_position(at);
  const Vec2 u = invert_in_triangle(at);
  return {triangle_tree_.invert(at.primitive, from, u.x), u.y};
}

}  // namespace mlt
