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
  end.next_coefficient = coefficient;
  end.next_throughput =
      end.throughput * vertex_terms(scene, end.vertex, w, w, false).f / coefficient;
}

bool Subpath::trace(const Walker& walker, const Ray& ray) {
  if (is_black(vertices_.back().next_throughput)) return false;
  vertices_.emplace_back();
  const WalkVertex& last = vertices_[size() - 2];
  WalkVertex& next = vertices_.back();
  SurfacePoint& at = next.vertex.at;
  const bool hit = walker.arrive(ray, at);
  if (!hit) {
    if (from_ == From::light || walker.scene.infinite_emitters().empty()) {
      vertices_.pop_back();
      return false;
    }
    at = Scene::point_at_infinity(ray.d);
  }
  next.throughput = last.next_throughput;
  next.survival = last.next_survival;
  next.towards_previous = -ray.d;
  next.G = geometry(last.vertex.at, at);
  next.forward = last.next_coefficient * next.G;
  return hit;
}

bool Subpath::scatter(const Walker& walker, const PathRules& rules, const Vec3& u,
                      double u_roulette) {
  WalkVertex& x = vertices_.back();
  const auto sample = walker.scatter(x.vertex.at, x.towards_previous, u);
  if (!sample) return false;
  const bool from_light = from_ == From::light;
  const VertexTerms terms = surface_terms(
      walker.scene, x.vertex.at, sample->lobe, from_light ? x.towards_previous : sample->w,
      from_light ? sample->w : x.towards_previous, rules.strict_normals);
  const double coefficient = from_light ? terms.pdf_from_light : terms.pdf_from_camera;
  const double back = from_light ? terms.pdf_from_camera : terms.pdf_from_light;
  if (!(coefficient > 0) || is_black(terms.f)) return false;
  const Color ratio = terms.f / coefficient;
  double survival = 1;
  if (static_cast<int>(size()) > rules.rr_depth) survival = std::min(max_component(ratio), 0.95);
  if (!(u_roulette < survival)) return false;
  x.vertex.lobe = sample->lobe;
  x.towards_next = sample->w;
  x.next_coefficient = coefficient;
  x.next_throughput = x.throughput * ratio / survival;
  x.next_survival = x.survival * survival;
  vertices_[size() - 2].reverse = back * x.G;
  return true;
}

}  // namespace mlt
