#include "path/subpath.h"

namespace mlt {

void Subpath::start(const Vertex& end, double position_pdf) {
  vertices_.clear();
  WalkVertex first;
  first.vertex = end;
  first.throughput = Color(1 / position_pdf);
  first.forward = position_pdf;
  vertices_.push_back(first);
}

void Subpath::leave(const Scene& scene, const Vec3& w, double coefficient) {
  WalkVertex& end = vertices_[0];
  end.towards_next = w;
  end.absorbed = false;
  end.next_coefficient = coefficient;
  end.next_throughput =
      end.throughput * vertex_terms(scene, end.vertex, w, w, false).f / coefficient;
}

void Subpath::append(const SurfacePoint& at, const Vec3& towards_previous) {
  WalkVertex next;
  const WalkVertex& last = vertices_.back();
  next.vertex = surface_vertex(at);
  next.throughput = last.next_throughput;
  next.towards_previous = towards_previous;
  next.G = geometry(last.vertex.at, at);
  next.forward = last.next_coefficient * next.G;
  vertices_.push_back(next);
}

bool Subpath::trace(const Scene& scene, const Ray& ray, RayCounts& rays) {
  if (is_black(vertices_.back().next_throughput)) return false;
  SurfacePoint at;
  ++rays.intersect;
  if (scene.intersect(ray, at)) {
    append(at, -ray.d);
    return true;
  }
  if (from_ == From::camera && !scene.infinite_emitters().empty())
    append(Scene::point_at_infinity(ray.d), -ray.d);
  return false;
}

bool Subpath::scatter(const Scene& scene, const WalkSettings& settings, const Vec3& u,
                      double u_roulette) {
  WalkVertex& x = vertices_.back();
  const SurfacePoint& at = x.vertex.at;
  const auto sample = scene.bsdf(at).sample(at, at.shading.to_local(x.towards_previous), u);
  if (!sample) return false;
  const Vec3 w = at.shading.to_world(sample->to);
  const bool from_light = from_ == From::light;
  const VertexTerms terms =
      surface_terms(scene, at, sample->lobe, from_light ? x.towards_previous : w,
                    from_light ? w : x.towards_previous, settings.strict_normals);
  const double coefficient = from_light ? terms.pdf_from_light : terms.pdf_from_camera;
  const double back = from_light ? terms.pdf_from_camera : terms.pdf_from_light;
  if (!(coefficient > 0) || is_black(terms.f)) return false;
  const Color ratio = terms.f / coefficient;
  double survival = 1;
  if (static_cast<int>(size()) > settings.rr_depth) survival = std::min(max_component(ratio), 0.95);
  if (!(u_roulette < survival)) return false;
  x.absorbed = false;
  x.lobe = sample->lobe;
  x.towards_next = w;
  x.next_coefficient = coefficient;
  x.next_throughput = x.throughput * ratio / survival;
  vertices_[size() - 2].reverse = back * x.G;
  return true;
}

}  // namespace mlt
