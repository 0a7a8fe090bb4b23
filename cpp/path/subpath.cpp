#include "path/subpath.h"

namespace mlt {

void Subpath::start(const Vertex& end, double position_pdf) {
  clear();
  WalkVertex& first = add();
  first.vertex = end;
  first.throughput = Color(1 / position_pdf);
  first.forward = position_pdf;
}

WalkVertex& Subpath::add() {
  if (size_ == vertices_.size()) vertices_.emplace_back();
  WalkVertex& added = vertices_[size_++];
  added.survival = added.next_survival = 1;
  added.towards_previous = Vec3(0);
  added.G = added.reverse = added.next_coefficient = 0;
  return added;
}

void Subpath::leave(const Scene& scene, const Vec3& w, double coefficient) {
  WalkVertex& end = vertices_[0];
  end.towards_next = w;
  end.next_coefficient = coefficient;
  end.next_throughput =
      end.throughput * vertex_terms(scene, end.vertex, w, w, false).f / coefficient;
}

bool Subpath::trace(const Walker& walker, const PathRules& rules, const Ray& ray) {
  if (vanishes(last().next_throughput * vertices_[0].forward)) return false;
  WalkVertex& next = add();
  WalkVertex& previous = vertices_[size() - 2];
  next.vertex = {};
  SurfacePoint& at = next.vertex.at;
  const bool hit = walker.arrive(ray, at);
  if (!hit) {
    if (from_ == From::light || walker.scene.infinite_emitters().empty()) {
      --size_;
      return false;
    }
    at = Scene::point_at_infinity(ray.d);
  }
  next.throughput = previous.next_throughput;
  next.survival = previous.next_survival;
  next.towards_previous = -ray.d;
  next.G = geometry(previous.vertex.at, at);
  next.forward = previous.next_coefficient * next.G;
  if (!at.lambertian.known()) return hit;
  prepare_joints(next, rules.strict_normals);
  previous.reverse = next.lambertian.back * next.G;
  return true;
}

void Subpath::prepare_joints(WalkVertex& x, bool strict_normals) const {
  const SurfacePoint& at = x.vertex.at;
  const Vec3& w = x.towards_previous;
  const double geometric = std::abs(dot(at.ng, w)), cosine = dot(at.shading.n, w);
  x.lambertian = {};
  if (geometric == 0 || !at.lambertian.scatters(cosine) || !consistent_sides(at, w, strict_normals))
    return;
  x.lambertian.cosine = cosine;
  x.lambertian.value = x.throughput * at.lambertian.f;
  if (from_ == From::light) x.lambertian.value *= std::abs(cosine) / geometric;
  x.lambertian.back = std::abs(cosine) * inv_pi / geometric;
}

bool Subpath::scatter(const Walker& walker, const PathRules& rules, const StepNumbers& u) {
  WalkVertex& x = last();
  Step step;
  if (!(x.vertex.at.lambertian.known()
            ? scatter_lambertian(x, u.direction, rules.strict_normals, step)
            : scatter(walker, x, u.for_scattering(), rules.strict_normals, step)))
    return false;
  double survival = 1;
  if (static_cast<int>(size()) > rules.rr_depth)
    survival = std::min(max_component(step.ratio), 0.95);
  if (!(u.roulette < survival)) return false;
  x.towards_next = step.w;
  x.next_coefficient = step.coefficient;
  x.next_throughput = x.throughput * step.ratio / survival;
  x.next_survival = x.survival * survival;
  return true;
}

bool Subpath::scatter(const Walker& walker, WalkVertex& x, const Vec3& u, bool strict, Step& step) {
  const auto sample = walker.scatter(x.vertex.at, x.towards_previous, u);
  if (!sample) return false;
  const bool from_light = from_ == From::light;
  const VertexTerms terms = surface_terms(walker.scene, x.vertex.at, sample->lobe,
                                          from_light ? x.towards_previous : sample->w,
                                          from_light ? sample->w : x.towards_previous, strict);
  const double coefficient = from_light ? terms.pdf_from_light : terms.pdf_from_camera;
  const double back = from_light ? terms.pdf_from_camera : terms.pdf_from_light;
  if (!(coefficient > 0) || is_black(terms.f)) return false;
  step = {sample->w, coefficient, terms.f / coefficient};
  x.vertex.lobe = sample->lobe;
  vertices_[size() - 2].reverse = back * x.G;
  return true;
}

/// See scatter(); on a Lambertian surface the coefficient is |w.ns| / (pi |w.ng|), and f has the
/// same quotient of cosines, of the direction on the light side (see VertexTerms).
bool Subpath::scatter_lambertian(const WalkVertex& x, const Vec2& u, bool strict,
                                 Step& step) const {
  const SurfacePoint& at = x.vertex.at;
  const auto to = at.lambertian.sample(x.lambertian.cosine, u);
  if (!to) return false;
  const Vec3 w = at.shading.to_world(*to);
  const double geometric = std::abs(dot(at.ng, w)), cosine = std::abs(to->z);
  if (geometric == 0 || !consistent_sides(at, w, strict) || is_black(at.lambertian.f)) return false;
  const double coefficient = cosine * inv_pi / geometric;
  step = {w, coefficient,
          at.lambertian.f * (from_ == From::light ? x.lambertian.back * pi / coefficient : pi)};
  return true;
}

}  // namespace mlt
