#include "path/specular_chain.h"

namespace mlt {

/// Eliminates from the last vertex on: with the blocks A, B, C of vertices i - 1, i, i + 1 in row
/// i, E_i = B_i - C_i E_{i+1}^{-1} A_{i+1}.
SpecularChain::SpecularChain(const Scene& scene, const Vertex* vertices, int count) {
  Mat2 above{0};        // E_{i+1}^{-1} A_{i+1}
  PlaneByPoint by_end;  // x_{i+1} by the end
  for (int i = count; i > 0; --i) {
    const auto c = specular_constraint(scene, vertices[i - 1].at, vertices[i], vertices[i + 1].at);
    if (!c) {
      density_ = 0;
      return;
    }
    const Frame own = Frame::around(vertices[i].at.ng);
    Mat2 diagonal = c->own.along(own);
    PlaneByPoint rest = c->after;
    if (i < count) {
      const Mat2 next = c->after.along(tangents_);
      diagonal -= next * above;
      rest = next * by_end;
    }
    const double det = glm::determinant(diagonal);
    density_ *= std::abs(det) / c->per_direction;
    const Mat2 inverse = glm::inverse(diagonal);
    by_end = -inverse * rest;
    if (i > 1) above = inverse * c->before.along(Frame::around(vertices[i - 1].at.ng));
    tangents_ = own;
  }
  by_end_ = by_end;
  if (!std::isfinite(density_)) density_ = 0;
}

Vec3 SpecularChain::first_move(const Vec3& end_move) const {
  const Vec2 move = by_end_ * end_move;
  return tangents_.s * move.x + tangents_.t * move.y;
}

}  // namespace mlt
