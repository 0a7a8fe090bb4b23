// The caustic perturbation (Veach & Guibas 1997, sec. 5.3.2.2; Veach 1997, sec. 11.3.3.2), for
// paths of the form (L|D)S*DE: the direction that leaves the light-side vertex turns by a small
// angle, the specular chain follows, and the diffuse vertex at its end is joined to the lens, at a
// new image position.
//
// Where the chain starts at a light at infinity its direction x_0 stays and the ray moves across
// the plane perpendicular to it. A surface that shines in one direction alone is left at another
// point: the two numbers that it is sampled by (invert_position) move. The angle (or the distance)
// is such that the image position moves about as far as the lens perturbation would move it:
// estimated from the path's lengths, or from the derivatives of the chain (`anisotropic`).
#include "mutation/chain_perturbation.h"
#include "mutation/edge_visibility.h"
#include "mutation/image_footprint.h"
#include "mutation/measured_mutation.h"
#include "mutation/mutation_registry.h"

namespace mlt {
namespace {

class CausticPerturbation final : public MeasuredMutation<CausticPerturbation> {
 public:
  CausticPerturbation(const PathTarget& target, Params& params)
      : MeasuredMutation("caustic", target),
        chain_(target.scene(), step_sizes(params)),
        anisotropic_(params.boolean("anisotropic")) {}

  double suitability(const PathState& x) const override { return start(x) >= 0 ? 1 : 0; }

  std::optional<Edit> propose(const PathState& x, PathState& y,
                              MutationContext& context) const override {
    const int k = x.edges(), a = start(x), first = first_moved(x, a);
    const Edit edit{first, k - 1, k - first};
    Rng& rng = context.rng;
    splice(x, edit, y);
    Ray ray;
    if (x[a].delta()) {
      y.path[0] = moved_along_light(x, rng);
      ray = scene().spawn(y[0].at, light(x).sample_ray(y[0].at, {}).direction, y.path.time);
    } else if (x[a].at.infinite()) {
      const double r = offset_radius(x).sample(rng.next()), phi = 2 * pi * rng.next();
      const Frame frame = Frame::around(x[0].at.p);
      const Vec3 through = x[1].at.p + r * (std::cos(phi) * frame.s + std::sin(phi) * frame.t);
      const Bounds& bounds = scene().bounds();
      const double back = dot(bounds.center - through, x[0].at.p) + bounds.radius;
      ray = {through + back * x[0].at.p, -x[0].at.p, y.path.time, infinity, x[0].at.medium};
      ray.wavelength = y.path.wavelength;
    } else {
      ray = scene().spawn(x[a].at, perturbed(x, a, rng), y.path.time);
    }
    if (!chain_.carry(x, {a, k - 1, 1}, ray, y, context)) return std::nullopt;
    target().evaluate(first, k - 1, y);
    test_visibility(scene(), k, y, context.rays);
    return edit;
  }

  template <class Measure>
  double density_in(const Measure& in, const PathState& x, const PathState& y,
                    const Edit& edit) const {
    const int k = x.edges(), a = start(x);
    if (a < 0 || a != start(y) || first_moved(x, a) != edit.first) return 0;
    double first;
    if (x[a].delta()) {
      if (x[0].emitter != y[0].emitter) return 0;
      first = along_light(x).planar_pdf(length(shift(position_numbers(x), position_numbers(y)))) *
              light(y).pdf_position(y[0].at);
    } else if (x[a].at.infinite()) {
      const Vec3 d = y[1].at.p - x[1].at.p;
      first = offset_radius(x).planar_pdf(length(d - dot(d, x[0].at.p) * x[0].at.p));
    } else {
      first = perturbed_pdf(x, a, y.terms[a].w) / abs_cos(y[a].at, y.terms[a].w);
    }
    return chain_.density(in, x, y, {a, k - 1, 1}, first);
  }

 private:
  /// The vertex from which the chain to the last diffuse vertex starts; -1: another form.
  int start(const PathState& x) const {
    const int last = x.edges() - 1;
    if (last < 1 || x.specular(last)) return -1;
    int i = last - 1;
    while (i > 0 && x.specular(i)) --i;
    return x[i].delta() && light(x).delta() ? -1 : i;
  }
  /// The first vertex that moves: the light itself, if it shines in one direction alone.
  static int first_moved(const PathState& x, int a) { return x[a].delta() ? a : a + 1; }

  const Emitter& light(const PathState& x) const { return *scene().emitters()[x[0].emitter]; }
  Vec2 position_numbers(const PathState& x) const { return light(x).invert_position(x[0].at); }
  /// The way from u to v on the torus of all pairs of numbers.
  static Vec2 shift(const Vec2& u, const Vec2& v) { return v - u - glm::round(v - u); }
  /// Lengths of that way: distances on the light as those of a ray from infinity.
  ExponentialRadius along_light(const PathState& x) const {
    const ExponentialRadius radius = offset_radius(x) * std::sqrt(light(x).pdf_position(x[0].at));
    if (radius.largest <= 0.5) return radius;
    return {std::min(radius.smallest, 0.25), 0.5};
  }
  Vertex moved_along_light(const PathState& x, Rng& rng) const {
    const double r = along_light(x).sample(rng.next()), phi = 2 * pi * rng.next();
    const Vec2 u = position_numbers(x) + r * Vec2(std::cos(phi), std::sin(phi));
    SurfacePoint at = light(x).sample_position(u - glm::floor(u), x.path.time).at;
    at.time = x.path.time;
    at.wavelength = x.path.wavelength;
    at.medium = x[0].at.medium;
    return light_vertex(light(x), at);
  }

  std::optional<ImageFootprint> footprint(const PathState& x, int a) const {
    if (!anisotropic_) return std::nullopt;
    return x.known.footprint.get(
        [&] { return ImageFootprint::of(scene(), x, a, chain_.pixel_angle(x)); });
  }
  Vec3 perturbed(const PathState& x, int a, Rng& rng) const {
    if (const auto ellipse = footprint(x, a)) return ellipse->perturb(chain_.image_radius(), rng);
    return ChainPerturbation::perturb(x.terms[a].w, chain_.angle(x, a, x.edges() - 1, 1), rng);
  }
  double perturbed_pdf(const PathState& x, int a, const Vec3& w) const {
    if (const auto ellipse = footprint(x, a)) return ellipse->pdf(w, chain_.image_radius());
    return chain_.angle(x, a, x.edges() - 1, 1).angular_pdf(angle_between(x.terms[a].w, w));
  }

  /// Distances by which a ray from infinity moves: the image radius times the width of a pixel at
  /// the end of the chain.
  ExponentialRadius offset_radius(const PathState& x) const {
    return chain_.image_radius() * (chain_.pixel_angle(x) * x.terms[x.edges() - 1].distance);
  }

  ChainPerturbation chain_;
  bool anisotropic_;
};

std::vector<Parameter> parameters() {
  std::vector<Parameter> all = step_size_parameters();
  all.push_back({"anisotropic", ParamType::boolean, true,
                 "Turn the direction by an ellipse whose image is round, not by a circle."});
  return all;
}

}  // namespace

MutationPlugin mutation_caustic() {
  return {{"mutation", "caustic",
           "caustic perturbation of paths (L|D)S*DE (Veach 1997, sec. 11.3.3.2).", parameters()},
          "caustic_perturbation",
          0.2,
          make_shared_mutation<CausticPerturbation>};
}

}  // namespace mlt
