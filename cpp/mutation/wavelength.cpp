// The wavelength mutation: the same path in light of other wavelengths. The number u of its
// wavelengths (wavelengths.h), or its place in the band of the film, moves by a step to either side
// or, half of the time, anywhere.
//
// What does not disperse stays where it is. A specular chain that does is found again between its
// ends, at the new wavelength, by a manifold walk that starts from the old chain (Jakob & Marschner
// 2012, sec. 4.3, where an end moves): so a caustic is followed through its colours. The density of
// u' is symmetric; with o the constraints of the chains, which stay, that of their vertices is the
// determinant of do / dx, as for the manifold perturbation.
//
// A light of one direction leaves no choice of a chain between two ends. Its ray starts where it
// did and is traced again, up to the first diffuse vertex, which is joined to the rest of the path:
// a caustic perturbation without a perturbation.
#include "mutation/chain_perturbation.h"
#include "mutation/edge_visibility.h"
#include "mutation/manifold_chain.h"
#include "mutation/measured_mutation.h"
#include "mutation/mutation_registry.h"

namespace mlt {
namespace {

/// From a to b on the circle of all u; at most 1/2.
double distance(double a, double b) {
  const double d = std::fabs(a - b);
  return std::min(d, 1 - d);
}

class WavelengthMutation final : public MeasuredMutation<WavelengthMutation> {
 public:
  WavelengthMutation(const PathTarget& target, Params& params)
      : MeasuredMutation("wavelength", target),
        step_(params.real_in("smallest_step", 1e-9, 0.5),
              params.real_in("largest_step", 1e-6, 0.5)),
        carried_(target.scene(), {}) {
    if (!(step_.log_ratio > 0)) params.fail("largest_step", "is not above smallest_step");
  }

  double suitability(const PathState& x) const override {
    if (!camera().spectral()) return 0;
    const int beam = beam_end(x);
    bool suits = beam == 0 || (beam < x.edges() && !x.specular(beam + 1));
    for_each_chain(
        x, [&](const ManifoldChain& chain) { suits = suits && chain.can_be_walked(scene(), x); });
    return suits ? 1 : 0;
  }

  std::optional<Edit> propose(const PathState& x, PathState& y,
                              MutationContext& context) const override {
    const int k = x.edges();
    const Edit all{0, k, k + 1};
    splice(x, all, y);
    y.path.vertices = x.path.vertices;
    change_wavelength(y.path, camera().wavelength_at(moved(number(x), context.rng)));
    const int beam = beam_end(x);
    bool found = beam == 0 || trace_beam(x, beam, y, context);
    for_each_chain(x, [&](const ManifoldChain& chain) {
      found = found && chain.find(scene(), x, y, context);
    });
    if (!found) return std::nullopt;
    target().evaluate(0, k, y);
    if (beam > 0) test_visibility(scene(), beam + 1, y, context.rays);
    if (!(y.target > 0)) return all;
    if (!same_form(x, y, 1, k - 1) || !is_measurable(x) || !is_measurable(y)) return std::nullopt;
    for_each_chain(x, [&](const ManifoldChain& chain) {
      found = found && chain.leads_back(scene(), x, y, context);
    });
    return found ? std::optional(all) : std::nullopt;
  }

  template <class Measure>
  double density_in(const Measure& in, const PathState& x, const PathState& y,
                    const Edit& edit) const {
    const int k = x.edges();
    if (edit.first != 0 || edit.last != k || y.edges() != k || !same_form(x, y, 1, k - 1)) return 0;
    const int beam = beam_end(y);
    if (beam != beam_end(x)) return 0;
    double p = step_density(number(x), number(y)) * unsampled(in, beam, k);
    if (beam > 0) p *= carried_.walked_density(in, x, y, {0, beam, 1}, 1.0);
    for_each_chain(y, [&](const ManifoldChain& chain) { p *= chain.jacobian(scene(), y); });
    return p;
  }

 private:
  const Camera& camera() const { return scene().camera(); }
  double number(const PathState& x) const { return camera().invert_wavelength(x.path.wavelength); }

  /// Whether |f| is a number: in long paths of scenes in tiny or huge units it is not.
  static bool is_measurable(const PathState& x) {
    const double f = magnitude(x.terms, 0, x.edges());
    return f > 1e-300 && f < 1e300;
  }

  double moved(double u, Rng& rng) const {
    if (rng.next() < 0.5) return rng.next();
    const double step = step_.sample(rng.next());
    const double v = rng.next() < 0.5 ? u - step : u + step;
    return std::min(v - std::floor(v), 1 - 0x1p-53);
  }
  double step_density(double from, double to) const {
    return 0.5 + 0.5 * step_.linear_pdf(distance(from, to));
  }

  void change_wavelength(Path& path, double u) const {
    path.set_wavelength(u);
    for (Vertex& x : path.vertices)
      if (x.kind == VertexKind::inner) x.at.lambertian = scene().bsdf(x.at).lambertian(x.at);
  }

  /// Whether a vertex between c and b disperses.
  static bool disperses(const PathState& x, int c, int b) {
    bool any = false;
    for (int i = c + 1; i < b; ++i) any = any || x.terms[i].vertex.disperses;
    return any;
  }
  /// The first vertex that is not specular, if light of one direction disperses before it; else 0.
  static int beam_end(const PathState& x) {
    if (!x[0].delta()) return 0;
    const int end = ChainPerturbation::chain_end(x, 0, 1);
    return disperses(x, 0, end) ? end : 0;
  }
  bool trace_beam(const PathState& x, int end, PathState& y, MutationContext& context) const {
    const Ray ray = scene().spawn(y[0].at, x.terms[0].w, y.path.time);
    return carried_.carry(x, {0, end, 1}, ray, y, context);
  }
  /// Calls see(chain) for each other specular chain that disperses.
  template <class See>
  static void for_each_chain(const PathState& x, See&& see) {
    const int beam = beam_end(x);
    for (int b = x.edges(); b > beam;) {
      const int c = ChainPerturbation::chain_end(x, b, -1);
      if (disperses(x, c, b)) see(ManifoldChain{c, b});
      b = c;
    }
  }

  ExponentialRadius step_;
  ChainPerturbation carried_;
};

}  // namespace

MutationPlugin mutation_wavelength() {
  return {
      {"mutation",
       "wavelength",
       "another wavelength for the same path; dispersive chains are found again.",
       {{"smallest_step", ParamType::real, 0.0005,
         "Smallest step, as a share of the visible range in the measure of what the eye sees, or "
         "of a band."},
        {"largest_step", ParamType::real, 0.1, "Largest step, likewise."}}},
      "wavelength_mutation",
      0.2,
      make_shared_mutation<WavelengthMutation>,
      /*on=*/true,
      [](const Scene& scene) { return scene.camera().spectral(); }};
}

}  // namespace mlt
