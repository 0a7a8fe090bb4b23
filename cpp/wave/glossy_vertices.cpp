#include "wave/glossy_vertices.h"

#include "wave/scatter_by_material.h"

namespace mlt {

int GlossyVertices::add(int path, const LaneMesh& shape, uint32_t triangle, const Vec2f& b,
                        double time, double wavelength) {
  GlossyVertex& vertex = vertices_[size_t(count_)];
  vertex.path = path;
  vertex.bsdf = shape.glossy;
  shape.mesh->textured_point(triangle, Vec2(b), vertex.at);
  vertex.at.time = time;
  vertex.at.wavelength = wavelength;
  vertex.frame.s = shape.mesh->along_u(triangle);
  vertex.light_pdf = 0;
  vertex.in_lanes = false;
  return count_++;
}

void GlossyVertices::find_frames(const LambertianVertices& points, const float* d_x,
                                 const float* d_y, const float* d_z) {
  for (GlossyVertex& vertex : *this) {
    const int i = vertex.path;
    vertex.frame = FrameOf<float>::around(points.n[i], vertex.frame.s);
    vertex.wc = vertex.frame.to_local({-d_x[i], -d_y[i], -d_z[i]});
  }
}

void GlossyVertices::scatter() {
  const auto put = [&](const GlossyVertex& vertex, int i) {
    lanes_.at[i] = &vertex.at;
    lanes_.wc.set(i, vertex.wc);
    lanes_.wl.set(i, vertex.light_pdf > 0 ? vertex.wl : Vec3f(0));
    lanes_.set_numbers(i, vertex.u_scatter);
  };
  const auto take = [&](GlossyVertex& vertex, int i) {
    vertex.f_light = lanes_.f_light[i];
    vertex.pdf_light = lanes_.pdf_light[i];
    vertex.to = vertex.frame.to_world(lanes_.to[i]);
    vertex.pdf = lanes_.pdf[i];
    vertex.f_cos = lanes_.f[i] * double{std::fabs(lanes_.to[i].z)};
  };
  scatter_by_material(begin(), end(), lanes_, put, take);
}

}  // namespace mlt
