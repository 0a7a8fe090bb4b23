#include "scene/solid/closed.h"

#include "scene/mesh/mesh.h"
#include "scene/shape/sphere.h"

#include <glm/matrix.hpp>

namespace mlt {
namespace {

constexpr double tolerance = 1e-3;

/// The volume that a mesh encloses.
std::optional<double> volume_of(const MeshData& mesh) {
  if (mesh.positions.empty()) return std::nullopt;
  const Vec3 origin(mesh.positions.front());
  Mat3 moments(0);
  Vec3 area(0);
  double total = 0;
  for (const auto& corners : mesh.triangles) {
    const auto corner = [&](int k) { return Vec3(mesh.positions[corners[k]]) - origin; };
    const Vec3 a = corner(0), b = corner(1), c = corner(2), n = 0.5 * cross(b - a, c - a);
    moments += glm::outerProduct((a + b + c) / 3.0, n);
    area += n;
    total += length(n);
  }
  const double volume = (moments[0][0] + moments[1][1] + moments[2][2]) / 3;
  const Mat3 wrong = moments - Mat3(volume);
  double worst = 0;
  for (int i = 0; i < 3; ++i) worst = std::max(worst, max_component(glm::abs(wrong[i])));
  const bool is_closed =
      volume != 0 && worst < tolerance * std::abs(volume) && length(area) < tolerance * total;
  return is_closed ? std::optional(std::abs(volume)) : std::nullopt;
}

}  // namespace

std::optional<double> enclosed_volume(const Shape& shape) {
  if (const Mesh* mesh = shape.as_mesh()) return volume_of(mesh->data());
  const auto* sphere = dynamic_cast<const Sphere*>(&shape);
  if (!sphere) return std::nullopt;
  return 4 * pi / 3 * sphere->radius() * sqr(sphere->radius());
}

}  // namespace mlt
