#include "path/subpath.h"

namespace mlt {

void Subpath::start(const Vertex& end, double position_pdf) {
  clear();
  WalkVertex& first = add();
  first.vertex = end;
  first.throughput = Spectrum(1 / position_pdf);
  first.forward = position_pdf;
}

WalkVertex& Subpath::add() {
  if (size_ == vertices_.size()) vertices_.emplace_back();
  WalkVertex& added = vertices_[size_++];
  added.survival = added.next_survival = added.passes = added.passes_back = 1;
  added.towards_previous = Vec3(0);
  added.passed = Spectrum(1);
  added.G = added.reverse = added.next_coefficient = 0;
  added.joint = {};
  added.dispersed = added.next_dispersed = false;
  return added;
}

void Subpath::leave(const Scene& scene, const Vec3& w, double coefficient) {
  WalkVertex& end = vertices_[0];
  end.towards_next = w;
  end.next_coefficient = coefficient;
  end.next_throughput =
      end.throughput * vertex_terms(scene, end.vertex, w, w, false).f / coefficient;
}

bool Subpath::trace(const Walker& walker, const PathRules& rules, const Ray& ray, double u_leg) {
  if (vanishes(last().next_throughput * vertices_[0].forward)) return false;
  WalkVertex& next = add();
  WalkVertex& previous = vertices_[size() - 2];
  next.vertex = {};
  SurfacePoint& at = next.vertex.at;
  Passage leg;
  leg.likelihood = previous.likelihood;
  const bool hit = walker.arrive(ray, u_leg, at, leg);
  if (!hit) {
    if (from_ == From::light || walker.scene.infinite_emitters().empty()) {
      --size_;
      return false;
    }
    at = Scene::point_at_infinity(ray);
  }
  next.throughput = previous.next_throughput;
  next.survival = previous.next_survival;
  next.dispersed = previous.next_dispersed;
  next.towards_previous = -ray.d;
  next.G = geometry(previous.vertex.at, at);
  next.forward = previous.next_coefficient * next.G;
  if (walker.scene.has_passages()) pass(walker.scene, leg);
  if (hit && BsdfAt(walker.scene, at).knows_density()) prepare_joints(next, rules.strict_normals);
  return hit;
}

void Subpath::pass(const Scene& scene, const Passage& leg) {
  WalkVertex& x = last();
  const SurfacePoint& previous = vertices_[size() - 2].vertex.at;
  const Arrival arrival = scene.arrival(leg, x.vertex.at, -x.towards_previous);
  x.passes = arrival.probability();
  x.likelihood = arrival.next_likelihood();
  const bool from_lens = from_ == From::camera && size() == 2;  // see EdgePassage
  x.back =
      from_lens ? Arrival() : scene.arrival(leg, previous, x.towards_previous).after(Spectrum(1));
  x.passes_back = scene.has_coloured_media() ? x.back.stops : x.back.probability();
  x.passed = leg.is_blocked() ? Spectrum(0) : leg.transmittance / x.passes;
  x.throughput *= x.passed;
  x.forward *= x.passes;
}

void Subpath::prepare_joints(WalkVertex& x, bool strict_normals) {
  const SurfacePoint& at = x.vertex.at;
  const double cosine = dot(at.shading.n, x.towards_previous);
  const auto edge = lambertian_edge(at.ng, at.shading.n, x.towards_previous,
                                    at.lambertian.scatters(cosine) ? cosine : 0, strict_normals);
  x.joint.known = true;
  if (edge.scatters) {
    x.joint.cosine = cosine;
    x.joint.value = x.throughput * at.lambertian.f;
    if (from_ == From::light) x.joint.value *= edge.quotient;
    x.joint.back = edge.density();
  }
  vertices_[size() - 2].reverse = x.density_back(x.joint.back);
}

std::optional<double> scatter(const Walker& walker, const PathRules& rules, Subpath::From from,
                              const StepNumbers& u, int place, WalkVertex& x) {
  const auto sample =
      BsdfAt(walker.scene, x.vertex.at).sample(x.towards_previous, u.for_scattering());
  if (!sample) return std::nullopt;
  const bool from_light = from == Subpath::From::light;
  const VertexTerms terms = inner_terms(
      walker.scene, x.vertex.at, sample->lobe, from_light ? x.towards_previous : sample->w,
      from_light ? sample->w : x.towards_previous, rules.strict_normals);
  const double coefficient = from_light ? terms.pdf_from_light : terms.pdf_from_camera;
  if (!(coefficient > 0) || is_black(terms.f)) return std::nullopt;
  const Spectrum ratio = terms.f / coefficient;
  const double survival =
      place < rules.rr_depth ? 1 : PathRules::survival(max_component(x.passed * ratio));
  if (!(u.roulette < survival)) return std::nullopt;
  x.vertex.lobe = sample->lobe;
  x.towards_next = sample->w;
  x.next_coefficient = coefficient;
  x.next_throughput = x.throughput * ratio / survival;
  x.next_survival = x.survival * survival;
  x.next_dispersed = x.dispersed || terms.disperses;
  return from_light ? terms.pdf_from_camera : terms.pdf_from_light;
}

bool Subpath::scatter(const Walker& walker, const PathRules& rules, const StepNumbers& u) {
  const int place = static_cast<int>(size()) - 1;
  const auto back = mlt::scatter(walker, rules, from_, u, place, last());
  if (back) vertices_[place - 1].reverse = last().density_back(*back);
  return back.has_value();
}

}  // namespace mlt
