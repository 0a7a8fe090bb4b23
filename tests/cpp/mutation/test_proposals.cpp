// Proposals from one path follow the density q(x -> y) that the mutation claims: chi-square tests
// of where the new vertex lies, as an image position, as a direction or as a point of the lens.
#include "harness/chi_square.h"
#include "mutation/chain_perturbation.h"
#include "mutation/mutation_testing.h"

namespace mlt::test {
namespace {

constexpr size_t proposals = 100000;
constexpr double alpha = 1e-4;

bool operator==(const Edit& a, const Edit& b) {
  return a.first == b.first && a.last == b.last && a.inserted == b.inserted;
}

/// One path and one mutation, whose proposals of one edit are looked at.
class Proposals {
 public:
  Proposals(const std::string& scene, const std::string& mutation, int max_depth = 8,
            const MutationValues& values = {})
      : scene_(make_scene(scene).scene),
        target_(path_target(scene_, max_depth)),
        mutation_(make_mutation(mutation, target_, values)) {}

  void start(const std::string& signature, const std::function<Edit(const PathState&)>& edit,
             const std::function<bool(const PathState&)>& suits = nullptr) {
    x = find_path(target_, signature, suits);
    edit_ = edit(x);
  }

  /// A proposal of this edit that carries light.
  bool propose(Rng& rng) {
    MutationContext context{rng, scratch_};
    const auto edit = mutation_->propose(x, y, context);
    return edit && *edit == edit_ && y.target > 0;
  }

  /// The density of the path whose one inserted (or moved) vertices are these, in the order of the
  /// path.
  double density(const std::vector<Vertex>& inserted) {
    splice(x, edit_, y);
    for (size_t i = 0; i < inserted.size(); ++i) y.path[edit_.first + i] = inserted[i];
    target_.evaluate(edit_.first, edit_.first + edit_.inserted - 1, y);
    if (!(y.target > 0)) return 0;
    for (int i = std::max(edit_.first, 1); i <= std::min(edit_.first + edit_.inserted, y.edges());
         ++i)
      if (!scene().visible(y[i - 1].at, y[i].at, 0)) return 0;
    return mutation_->density(x, y, edit_);
  }

  std::optional<SurfacePoint> trace(const SurfacePoint& from, const Vec3& w) const {
    SurfacePoint at;
    const Ray ray =
        from.shape == SurfacePoint::no_shape ? Ray{from.p, w, 0} : scene().spawn(from, w, 0);
    if (!scene().intersect(ray, at)) return std::nullopt;
    return at;
  }

  const Scene& scene() const { return *scene_; }

  PathState x, y;

 private:
  ScenePtr scene_;
  PathTarget target_;
  MutationPtr mutation_;
  Edit edit_{};
  MutationScratch scratch_;
};

/// Density in solid angle at `from` of a point with this density in area.
double per_direction(const SurfacePoint& from, const SurfacePoint& to, double density) {
  const Vec3 d = to.p - from.p;
  return density * length_squared(d) / abs_cos(to, normalize(d));
}

/// Density per area of the image of x_{k-1} with this density in area.
double per_pixel(const PathState& y, const ChainPerturbation& chain, double density) {
  return density / (y.terms[y.edges() - 1].G * chain.raster_per_direction(y));
}

TEST(Proposals, BidirectionalMutationInsertsOneVertexBetweenTwo) {
  Proposals p("point", "bidirectional");
  p.start("LDDE", [](const PathState&) { return Edit{1, 1, 1}; });
  const SurfacePoint from = p.x[2].at;
  const auto sample = [&](Rng& rng) -> std::optional<Vec3> {
    if (!p.propose(rng)) return std::nullopt;
    return from.shading.to_local(direction(from, p.y[1].at));
  };
  const auto pdf = [&](const Vec3& w) {
    const auto at = p.trace(from, from.shading.to_world(w));
    return at ? per_direction(from, *at, p.density({inner_vertex(*at)})) : 0.0;
  };
  const ChiSquareResult result = chi_square_sphere(sample, pdf, proposals, 1);
  EXPECT_GT(result.p_value, alpha) << result;
  EXPECT_LT(result.failure_rate, 0.99) << result;
}

TEST(Proposals, BidirectionalMutationInsertsTheVertexThatIsSeen) {
  Proposals p("cornell", "bidirectional");
  p.start("LDDE", [](const PathState&) { return Edit{2, 2, 1}; });
  const ChainPerturbation chain(p.scene(), StepSizes());
  const SurfacePoint& lens = p.x[3].at;
  const auto sample = [&](Rng& rng) -> std::optional<Vec2> {
    if (!p.propose(rng)) return std::nullopt;
    return p.y.raster;
  };
  const auto pdf = [&](const Vec2& raster) {
    const auto at = p.trace(lens, p.scene().camera().direction(lens, raster));
    const double density = at ? p.density({inner_vertex(*at)}) : 0.0;
    return density > 0 ? per_pixel(p.y, chain, density) : 0;
  };
  const ChiSquareResult result = chi_square_rect(sample, pdf, {0, 0}, {16, 12}, proposals, 2);
  EXPECT_GT(result.p_value, alpha) << result;
  EXPECT_LT(result.failure_rate, 0.99) << result;
}

TEST(Proposals, BidirectionalMutationMovesTheEndOnTheLens) {
  // Half of the time the lens point is drawn, half of the time a light walk is to hit the lens.
  Proposals p("lens_through_mirror", "bidirectional", 4);
  p.start("LE", [](const PathState&) { return Edit{1, 1, 1}; });
  const Camera& camera = p.scene().camera();
  const SurfacePoint& xk = p.x[1].at;
  const SurfacePoint center = camera.sample_position(Vec2(0.5), 0).at;
  const double radius = camera.lens_radius();
  const auto sample = [&](Rng& rng) -> std::optional<Vec2> {
    if (!p.propose(rng)) return std::nullopt;
    const Vec3 d = p.y[1].at.p - center.p;
    return Vec2(dot(d, xk.shading.s), dot(d, xk.shading.t));
  };
  const auto pdf = [&](const Vec2& d) {
    if (glm::length(d) >= radius) return 0.0;
    SurfacePoint at = center;
    at.p += d.x * xk.shading.s + d.y * xk.shading.t;
    return p.density({camera_vertex(at)});
  };
  const ChiSquareResult result =
      chi_square_rect(sample, pdf, Vec2(-radius), Vec2(radius), proposals, 3);
  EXPECT_GT(result.p_value, alpha) << result;
  EXPECT_LT(result.failure_rate, 0.99) << result;
}

TEST(Proposals, BidirectionalMutationDrawsAFreshLightEnd) {
  Proposals p("mixed_lights", "bidirectional");
  const auto on_lamp = [&](const PathState& x) {
    return !x[0].at.infinite() && x[0].at.shape != SurfacePoint::no_shape && x[0].at.p.y > 0.97 &&
           p.scene().emitter_probability_for(x[0].emitter, x[1].at.p) > 0.1;
  };
  p.start("LDDE", [](const PathState&) { return Edit{0, 0, 1}; }, on_lamp);
  const Emitter& lamp = *p.scene().emitters()[p.x[0].emitter];
  const auto sample = [&](Rng& rng) -> std::optional<Vec2> {
    if (!p.propose(rng) || p.y[0].emitter != lamp.index()) return std::nullopt;
    return lamp.invert_position(p.y[0].at);
  };
  const auto pdf = [&](const Vec2& u) {
    const PositionSample x0 = lamp.sample_position(u, 0);
    return p.density({light_vertex(lamp, x0.at)}) / x0.pdf;
  };
  const ChiSquareResult result = chi_square_rect(sample, pdf, {0, 0}, {1, 1}, proposals, 4);
  EXPECT_GT(result.p_value, alpha) << result;
  // Of five lights at most every seventh choice is this lamp; hundreds are enough for these cells.
  EXPECT_GT((1 - result.failure_rate) * proposals, 500) << result;
}

TEST(Proposals, LensPerturbationMovesTheImagePosition) {
  Proposals p("cornell", "lens");
  const auto in_the_middle = [](const PathState& x) {
    return std::abs(x.raster.x - 8) < 3 && std::abs(x.raster.y - 6) < 2;
  };
  p.start("LDE", [](const PathState&) { return Edit{1, 2, 2}; }, in_the_middle);
  const ChainPerturbation chain(p.scene(), StepSizes());
  const ExponentialRadius radius = chain.image_radius();
  const auto sample = [&](Rng& rng) -> std::optional<Vec2> {
    if (!p.propose(rng)) return std::nullopt;
    const Vec2 d = p.y.raster - p.x.raster;
    return Vec2(std::log(glm::length(d)), std::atan2(d.y, d.x));
  };
  const auto pdf = [&](const Vec2& polar) {
    const double r = std::exp(polar.x);
    const Vec2 raster = p.x.raster + r * Vec2(std::cos(polar.y), std::sin(polar.y));
    const auto at = p.trace(p.x[2].at, p.scene().camera().direction(p.x[2].at, raster));
    const double density = at ? p.density({inner_vertex(*at), p.x[2]}) : 0.0;
    return density > 0 ? per_pixel(p.y, chain, density) * r * r : 0;
  };
  const ChiSquareResult result =
      chi_square_rect(sample, pdf, {std::log(radius.smallest) - 1e-9, -pi},
                      {std::log(radius.largest) + 1e-9, pi}, proposals, 5);
  EXPECT_GT(result.p_value, alpha) << result;
  EXPECT_LT(result.failure_rate, 0.5) << result;
}

TEST(Proposals, LensPerturbationMovesThePointOnTheLens) {
  Proposals p("thin_lens", "lens");
  p.start("LDE", [](const PathState&) { return Edit{1, 2, 2}; });
  const SurfacePoint xk = p.x[2].at;
  const double radius = p.scene().camera().lens_radius();
  // Half of the proposals stay; of the others, the part within the rim has a density of 1 / (2 pi
  // r^2 ln).
  const auto sample = [&](Rng& rng) -> std::optional<Vec2> {
    // Whether the rest of the path is found does not depend on the lens alone: all that move are
    // counted.
    p.propose(rng);
    const Vec3 d = p.y[2].at.p - xk.p;
    if (length_squared(d) == 0 || p.y[2].kind != VertexKind::camera) return std::nullopt;
    return Vec2(std::log(length(d)), std::atan2(dot(d, xk.shading.t), dot(d, xk.shading.s)));
  };
  const ExponentialRadius distance{1e-3 * radius, radius / 3};
  const auto pdf = [&](const Vec2& polar) {
    const double r = std::exp(polar.x);
    if (!p.scene().camera().move_on_lens(xk, r * Vec2(std::cos(polar.y), std::sin(polar.y))))
      return 0.0;
    return 0.5 * distance.planar_pdf(r) * r * r;
  };
  const ChiSquareResult result =
      chi_square_rect(sample, pdf, {std::log(distance.smallest) - 1e-9, -pi},
                      {std::log(distance.largest) + 1e-9, pi}, proposals, 6);
  EXPECT_GT(result.p_value, alpha) << result;
}

/// The direction that leaves x_0 or a diffuse vertex, around that of x; as far to all sides.
void expect_caustic_follows_density(const std::string& scene, const std::string& signature,
                                    uint64_t seed) {
  Proposals p(scene, "caustic", 8, {{"anisotropic", false}});
  p.start(signature, [](const PathState& x) { return Edit{x.edges() - 1, x.edges() - 1, 1}; });
  const int k = p.x.edges();
  const SurfacePoint from = p.x[k - 2].at;
  const Vec3 axis = direction(from, p.x[k - 1].at);
  const Frame frame = Frame::around(axis);
  const ChainPerturbation chain(p.scene(), StepSizes());
  const ExponentialRadius angle = chain.angle(p.x, k - 2, k - 1, 1);
  const auto sample = [&](Rng& rng) -> std::optional<Vec2> {
    if (!p.propose(rng)) return std::nullopt;
    const Vec3 w = frame.to_local(direction(from, p.y[k - 1].at));
    return Vec2(std::log(std::atan2(std::hypot(w.x, w.y), w.z)), std::atan2(w.y, w.x));
  };
  const auto pdf = [&](const Vec2& polar) {
    const double theta = std::exp(polar.x);
    const Vec3 w = frame.to_world({std::sin(theta) * std::cos(polar.y),
                                   std::sin(theta) * std::sin(polar.y), std::cos(theta)});
    const auto at = p.trace(from, w);
    return at ? per_direction(from, *at, p.density({inner_vertex(*at)})) * std::sin(theta) * theta
              : 0.0;
  };
  const ChiSquareResult result =
      chi_square_rect(sample, pdf, {std::log(angle.smallest) - 1e-3, -pi},
                      {std::log(angle.largest) + 1e-3, pi}, proposals, seed);
  EXPECT_GT(result.p_value, alpha) << result;
  EXPECT_LT(result.failure_rate, 0.9) << result;
}

TEST(Proposals, CausticPerturbationTurnsTheDirectionFromASurface) {
  expect_caustic_follows_density("cornell", "LDDE", 7);
}
TEST(Proposals, CausticPerturbationTurnsTheDirectionFromALamp) {
  expect_caustic_follows_density("cornell", "LDE", 8);
}
TEST(Proposals, CausticPerturbationTurnsTheDirectionFromAPointLight) {
  expect_caustic_follows_density("point", "LDE", 9);
}

TEST(Proposals, CausticPerturbationMovesARayFromInfinity) {
  Proposals p("sun", "caustic");
  p.start("LDE", [](const PathState&) { return Edit{1, 1, 1}; });
  const Vec3 sun = p.x[0].at.p;
  const Frame frame = Frame::around(sun);
  const auto sample = [&](Rng& rng) -> std::optional<Vec2> {
    if (!p.propose(rng)) return std::nullopt;
    const Vec3 d = frame.to_local(p.y[1].at.p - p.x[1].at.p);
    return Vec2(std::log(std::hypot(d.x, d.y)), std::atan2(d.y, d.x));
  };
  const auto pdf = [&](const Vec2& polar) {
    const double r = std::exp(polar.x);
    const Vec3 through =
        p.x[1].at.p + r * (std::cos(polar.y) * frame.s + std::sin(polar.y) * frame.t);
    SurfacePoint at;
    if (!p.scene().intersect({through + 100.0 * sun, -sun, 0}, at)) return 0.0;
    return p.density({inner_vertex(at)}) / abs_cos(at, sun) * r * r;
  };
  const ChiSquareResult result =
      chi_square_rect(sample, pdf, {std::log(1e-6), -pi}, {std::log(10.0), pi}, proposals, 10);
  EXPECT_GT(result.p_value, alpha) << result;
  EXPECT_LT(result.failure_rate, 0.9) << result;
}

void expect_lens_subpath_follows_density(const std::string& scene, const std::string& signature,
                                         uint64_t seed) {
  Proposals p(scene, "lens_subpath");
  p.start(signature, [](const PathState& x) { return Edit{x.edges() - 1, x.edges(), 2}; });
  const int k = p.x.edges();
  const ChainPerturbation chain(p.scene(), StepSizes());
  const SurfacePoint lens = p.x[k].at;
  const auto sample = [&](Rng& rng) -> std::optional<Vec2> {
    if (!p.propose(rng)) return std::nullopt;
    return p.y.raster;
  };
  const auto pdf = [&](const Vec2& raster) {
    const auto at = p.trace(lens, p.scene().camera().direction(lens, raster));
    const double density = at ? p.density({inner_vertex(*at), p.x[k]}) : 0.0;
    return density > 0 ? per_pixel(p.y, chain, density) : 0;
  };
  const ChiSquareResult result = chi_square_rect(sample, pdf, {0, 0}, {16, 12}, proposals, seed);
  EXPECT_GT(result.p_value, alpha) << result;
  EXPECT_LT(result.failure_rate, 0.9) << result;
}

TEST(Proposals, LensSubpathIsUniformOnTheImage) {
  expect_lens_subpath_follows_density("point", "LDE", 11);
}
TEST(Proposals, LensSubpathStopsByChanceWhereItMayReflect) {
  expect_lens_subpath_follows_density("plastic", "LDDE", 12);
}

}  // namespace
}  // namespace mlt::test
