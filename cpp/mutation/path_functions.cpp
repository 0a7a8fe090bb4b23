#include "mutation/path_functions.h"

#include <array>

namespace mlt {
namespace {

constexpr int columns = 4, rows = 3;
constexpr int longest = 9, most_lights = 8, most_specular = 5;

/// Collects the values of all functions; the same calls in the same order give their names.
class Collector {
 public:
  explicit Collector(std::vector<double>* values) : values_(values) {}
  Collector(std::vector<std::string>* names, std::vector<size_t>* numbers)
      : names_(names), numbers_(numbers) {}

  void number(const char* name, double value) {
    if (names_) {
      numbers_->push_back(names_->size());
      names_->push_back(name);
    }
    if (values_) values_->push_back(value);
  }
  /// One function for each of `count` cases: 1 in the case that holds, otherwise 0.
  void cases(const char* name, int holds, int count) {
    for (int i = 0; i < count; ++i) {
      if (names_) names_->push_back(std::string(name) + " " + std::to_string(i));
      if (values_) values_->push_back(i == std::min(holds, count - 1) ? 1 : 0);
    }
  }

 private:
  std::vector<double>* values_ = nullptr;
  std::vector<std::string>* names_ = nullptr;
  std::vector<size_t>* numbers_ = nullptr;
};

int octant(const Vec3& v) { return (v.x > 0) + 2 * (v.y > 0) + 4 * (v.z > 0); }

int octant(const SurfacePoint& at, const Bounds& bounds) {
  return octant(at.infinite() ? at.p : at.p - bounds.center);
}

/// The logarithm, bounded from below, so that no single path outweighs the others.
double bounded_log(double x) { return std::log(std::max(x, 1e-12)); }

/// Waves of one and of two periods over the image: they see steps that are wider in a part of it.
void waves(double u, const std::array<const char*, 4>& names, Collector& g) {
  const double cosine = std::cos(2 * pi * u), sine = std::sin(2 * pi * u);
  g.number(names[0], cosine);
  g.number(names[1], sine);
  g.number(names[2], sqr(cosine) - sqr(sine));
  g.number(names[3], 2 * sine * cosine);
}

void collect(const Scene& scene, const PathState& x, Collector& g) {
  const int k = x.edges();
  const Bounds& bounds = scene.bounds();
  const Vec2 image = x.raster / Vec2(scene.camera().raster().size);
  const auto cell = [](double u, int n) {
    return std::clamp(static_cast<int>(std::floor(u * n)), 0, n - 1);
  };
  g.cases("image block", cell(image.y, rows) * columns + cell(image.x, columns), rows * columns);
  g.number("image x", image.x);
  g.number("image y", image.y);
  g.number("distance from the image's centre", glm::length(image - 0.5));
  waves(image.x, {"cosine of x", "sine of x", "cosine of 2 x", "sine of 2 x"}, g);
  waves(image.y, {"cosine of y", "sine of y", "cosine of 2 y", "sine of 2 y"}, g);
  g.cases("edges", k, longest + 1);
  g.cases("light", static_cast<int>(x[0].emitter), most_lights);

  int specular = 0, deltas = 0;
  for (int i = 1; i < k; ++i) {
    specular += x.specular(i);
    deltas += x[i].delta();
  }
  g.cases("specular vertices", specular, most_specular + 1);
  g.cases("delta vertices", deltas, most_specular + 1);

  g.cases("octant of x_0", octant(x[0].at, bounds), 8);
  g.cases("octant of x_1", octant(x[1].at, bounds), 8);
  g.cases("octant of the middle", octant(x[k / 2].at, bounds), 8);
  g.cases("octant of x_{k-1}", octant(x[k - 1].at, bounds), 8);
  const Vec2 lens = scene.camera().invert_position(x[k].at);
  g.cases("quarter of the lens", (lens.x > 0.5) + 2 * (lens.y > 0.5), 4);
  g.number("time", x.path.time);
  const Camera& camera = scene.camera();
  if (camera.spectral()) g.number("wavelength", camera.invert_wavelength(x.path.wavelength));

  double shortest = 4, longest_edge = 0, smallest_G = infinity;
  for (int i = 0; i < k; ++i) {
    smallest_G = std::min(smallest_G, x.terms[i].G);
    if (x[i].at.infinite()) continue;
    const double edge = length(x[i + 1].at.p - x[i].at.p) / bounds.radius;
    shortest = std::min(shortest, edge);
    longest_edge = std::max(longest_edge, edge);
  }
  const auto edge_log = [&](int i) {
    return x[i].at.infinite() ? 0.0
                              : bounded_log(length(x[i + 1].at.p - x[i].at.p) / bounds.radius);
  };
  g.number("log |x_0 - x_1|", edge_log(0));
  g.number("log |x_{k-1} - x_k|", edge_log(k - 1));
  g.number("log of the shortest edge", bounded_log(shortest));
  g.number("log of the longest edge", bounded_log(longest_edge));
  g.number("log of the smallest G", bounded_log(smallest_G * sqr(bounds.radius)));
  g.number("cosine at x_0", abs_cos(x[0].at, direction(x[0].at, x[1].at)));
  g.number("cosine at x_1", abs_cos(x[1].at, direction(x[1].at, x[0].at)));
  g.number("cosine at x_{k-1}", abs_cos(x[k - 1].at, direction(x[k - 1].at, x[k].at)));
  g.number("log L*", bounded_log(x.brightness()));
  g.number("share of red", x.rgb.x / x.target);
  g.number("share of blue", x.rgb.z / x.target);
}

}  // namespace

PathFunctions::PathFunctions(const Scene& scene) : scene_(&scene) {
  PathState any;
  any.path.vertices.resize(2);
  any.path[1].at.p = Vec3(1);
  any.terms.at.resize(2);
  any.terms[0].G = 1;
  any.target = 1;
  Collector collector(&names_, &numbers_);
  collect(scene, any, collector);
}

void PathFunctions::evaluate(const PathState& x, std::vector<double>& values) const {
  values.clear();
  Collector collector(&values);
  collect(*scene_, x, collector);
}

}  // namespace mlt
