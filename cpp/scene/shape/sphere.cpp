// Intersection after Haines et al. 2019, "Precision improvements for ray/sphere intersection" (Ray
// Tracing Gems, ch. 7). Sampling from outside after Shirley, Wang & Zimmerman 1996, "Monte Carlo
// techniques for direct lighting calculations", sec. 3.2, written without cancellation so that it
// holds from the surface to any distance.
#include "scene/shape/sphere.h"

#include "math/warp.h"
#include "scene/mesh/mesh_data.h"
#include "scene/shape/common.h"
#include "scene/texture/texture.h"
#include "scene/transform/matrix_rows.h"
#include "scene/transform/transform_params.h"

namespace mlt {

/// The cone of a sphere. In the triangle (from, centre, point on the near side) theta is the angle
/// at `from`, at most theta_max; alpha the one at the centre.
struct Sphere::Cone {
  Frame frame;           ///< Around the direction from the centre to `from`.
  double distance;       ///< Distance from `from` to the centre.
  double cos_max;        ///< cos theta_max
  double one_minus_cos;  ///< 1 - cos theta_max
};

namespace {

/// Whether linear = scale * Q with orthogonal Q, to the few digits that scene files carry.
bool is_round(const Mat3& linear, double scale) {
  const Mat3 gram = glm::transpose(linear) * linear / (scale * scale);
  double deviation = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) deviation = std::max(deviation, std::abs(gram[i][j] - (i == j)));
  return deviation < 1e-3;
}

double mean_scale(const Mat3& linear) { return std::cbrt(std::abs(glm::determinant(linear))); }

}  // namespace

void place_ellipsoid(Params& params) {
  if (!params.has("to_world")) return;
  const auto* matrix = std::get_if<Matrix>(&params.value("to_world"));
  if (!matrix) return;
  const Mat4 to_world = from_rows(*matrix);
  if (!is_affine(to_world) || is_singular(to_world)) return;  // rejected by Sphere
  const Mat3 linear(to_world);
  if (!is_round(linear, mean_scale(linear))) params.replace("to_world", Animation{{0, *matrix}});
}

Sphere::Sphere(const Vec3& center, double radius, const Mat4& to_world, bool flip_normals,
               const Location& location) {
  where = location;
  const Mat3 linear(to_world);
  const double scale = mean_scale(linear);
  if (!(radius > 0) || !std::isfinite(radius))
    throw SceneError(at(where, "the radius of a sphere must be positive"));
  if (!(scale > 0) || !std::isfinite(scale))
    throw SceneError(at(where, "'to_world' is singular: it flattens the sphere"));
  if (!is_round(linear, scale) || !is_affine(to_world))
    throw SceneError(at(where,
                        "'to_world' makes this sphere an ellipsoid; only translation, rotation "
                        "and one scale for all axes are possible (use a mesh instead)"));
  center_ = transform_point(to_world, center);
  radius_ = radius * scale;
  to_object_ = glm::transpose(linear / scale);
  const bool mirrored = glm::determinant(linear) < 0;
  side_ = mirrored != flip_normals ? -1 : 1;
  set_extent();
}

Sphere::Sphere(Params& params)
    : Sphere(vector_param(params, "center"), params.real("radius"),
             matrix_param(params, "to_world"), params.boolean("flip_normals"), params.where()) {}

std::optional<Sphere::Roots> Sphere::roots(const Vec3& o, const Vec3& d) const {
  const Vec3 f = o - center_;
  const double b = -dot(f, d);
  const double discriminant = sqr(radius_) - length_squared(f + b * d);
  if (discriminant < 0) return std::nullopt;
  const double q = b + std::copysign(std::sqrt(discriminant), b);
  const double distance = length(f);
  // The product of the roots is |f|^2 - r^2.
  const double other = q == 0 ? 0 : (distance - radius_) * (distance + radius_) / q;
  return Roots{std::min(q, other), std::max(q, other)};
}

std::optional<double> Sphere::intersect(const Vec3& o, const Vec3& d, double t_min,
                                        double t_max) const {
  const std::optional<Roots> t = roots(o, d);
  return t ? t->nearest(t_min, t_max) : std::nullopt;
}

void Sphere::surface_point(const Ray& ray, const Hit& hit, SurfacePoint& at) const {
  const std::optional<Roots> exact = roots(ray.o, ray.d);
  const double t = exact ? exact->meant_by(hit.t) : hit.t;
  at = point(normalize(ray.o + ray.d * t - center_));
}

SurfacePoint Sphere::point(const Vec3& outward) const {
  const Vec3 local = to_object_ * outward;
  const Vec3 ng = outward * side_;
  return point_at(
      center_ + outward * radius_, ng, Frame::around(ng, Vec3(-local.y, local.x, 0) * to_object_),
      {turns(local.x, local.y), 2 * signed_turns(local.z, std::hypot(local.x, local.y))});
}

Shape::UvTangents Sphere::uv_tangents(const SurfacePoint& at) const {
  const Vec3 local = to_object_ * ((at.p - center_) / radius_);
  const double r = std::hypot(local.x, local.y);
  const Vec3 along(-local.y, local.x, 0);
  const Vec3 down = r > 0 ? Vec3(local.x * local.z / r, local.y * local.z / r, -r) : Vec3(0);
  return {along * to_object_ * (2 * pi * radius_), down * to_object_ * (pi * radius_)};
}

double Sphere::area() const { return 4 * pi * sqr(radius_); }

PositionSample Sphere::sample_position(const Vec2& u) const {
  return {point(sample_uniform_sphere(u)), 1 / area()};
}

Vec2 Sphere::invert_position(const SurfacePoint& at) const {
  return invert_uniform_sphere(normalize(at.p - center_));
}

std::optional<Sphere::Cone> Sphere::cone(const Vec3& from) const {
  const Vec3 z = from - center_;
  const double distance = length(z);
  // Points inside see all of it, and only they see one that shines inwards: those on its surface,
  // too, on whichever side rounding leaves them.
  if (side_ < 0 || !(distance > radius_ * (1 + 1e-9)) || !std::isfinite(distance))
    return std::nullopt;
  const double sin_max = radius_ / distance;
  const double cos_max = std::sqrt((distance - radius_) * (distance + radius_)) / distance;
  return Cone{Frame::around(z / distance), distance, cos_max, sqr(sin_max) / (1 + cos_max)};
}

PositionSample Sphere::sample_direct(const Vec3& from, const Vec2& u) const {
  const std::optional<Cone> c = cone(from);
  if (!c) return sample_position(u);
  // beta is the angle between the outward normal at the point and the direction to `from`: by the
  // law of sines sin beta = sin theta / sin theta_max, and alpha = beta - theta.
  const double height = u.x * c->one_minus_cos;  // 1 - cos theta
  const double cos_t = 1 - height, sin_t = std::sqrt(height * (2 - height));
  const double sin_b = std::sqrt(u.x * (2 - height) / (1 + c->cos_max));
  const double cos_b =
      std::sqrt((1 - u.x) * (1 + c->cos_max - u.x * (1 - c->cos_max)) / (1 + c->cos_max));
  const double sin_a = sin_b * cos_t - cos_b * sin_t, cos_a = cos_b * cos_t + sin_b * sin_t;
  const SinCos phi = sincos_turns(u.y);
  const Vec3 outward = normalize(c->frame.to_world({sin_a * phi.cos, sin_a * phi.sin, cos_a}));
  const SurfacePoint at = point(outward);
  return {at, pdf_in(*c, from, at)};
}

double Sphere::pdf_direct(const Vec3& from, const SurfacePoint& at) const {
  const std::optional<Cone> c = cone(from);
  return c ? pdf_in(*c, from, at) : 1 / area();
}

double Sphere::pdf_in(const Cone& cone, const Vec3& from, const SurfacePoint& at) const {
  const Vec3 back = from - at.p;
  const double distance2 = length_squared(back);
  const double cosine = dot(at.ng, back) * side_ / std::sqrt(distance2);
  if (!(cosine > 0)) return 0;
  return cone_pdf(cone.one_minus_cos) * cosine / distance2;
}

Vec2 Sphere::invert_direct(const Vec3& from, const SurfacePoint& at) const {
  const std::optional<Cone> c = cone(from);
  if (!c) return invert_position(at);
  const Vec3 local = c->frame.to_local(normalize(at.p - center_));
  // sin theta = radius sin alpha / |p - from|, and u.x = (1 - cos theta) / (1 - cos theta_max).
  const double sin2_a = sin2_theta(local);
  const double distance2 = length_squared(at.p - from);
  const double cos_t = (c->distance - radius_ * local.z) / std::sqrt(distance2);
  const double x = sin2_a * sqr(c->distance) / distance2 * (1 + c->cos_max) / (1 + cos_t);
  return {std::min(x, 1 - 0x1p-53), turns(local.x, local.y)};
}

void Sphere::bounds(Vec3& low, Vec3& high) const {
  low = center_ - Vec3(radius_);
  high = center_ + Vec3(radius_);
}

Plugin shape_sphere() {
  return make_plugin<Sphere>(
      shape_schema("sphere", "A sphere.",
                   {{"center", ParamType::point, Triple{0, 0, 0}, "In object space."},
                    {"radius", ParamType::real, 1.0, "In object space."}}));
}

}  // namespace mlt
