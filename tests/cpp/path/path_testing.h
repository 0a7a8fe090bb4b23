// Paths for tests, and their densities and weights by a second implementation that knows nothing of
// the first: directions and densities in solid angle, asked from the plug-ins one by one.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "path/bidirectional_sampler.h"
#include "path/path_terms.h"
#include "path/samplers.h"
#include "scenes.h"

namespace mlt::test {

/// Walks as long as the test wants: roulette is not part of any density.
inline BidirectionalSettings without_roulette(int max_depth) {
  BidirectionalSettings settings;
  settings.rules.max_depth = max_depth;
  settings.rules.rr_depth = 1 << 20;
  return settings;
}

/// Calls found(connection, path) for all paths of `samples` pairs of subpaths.
template <class Found>
void for_each_path(const Scene& scene, const BidirectionalSettings& settings, uint64_t seed,
                   int samples, Found&& found) {
  BidirectionalSampler bidirectional(scene, settings);
  RayCounts rays;
  Path path;
  for (int i = 0; i < samples; ++i) {
    Rng rng(seed, Purpose::test, static_cast<uint64_t>(i));
    RandomSampler sampler(rng);
    bidirectional.sample(scene.camera().raster().sample(sampler.next2()), sampler, rays);
    bidirectional.connect_all(rays, [&](const Connection& connection) {
      bidirectional.assemble(connection, path);
      found(connection, path);
    });
  }
}

/// The weights of a connection by the terms of its path.
inline MisWeights weights_by_terms(const Connection& c, const PathTerms& terms,
                                   const ExtraTechnique& extra, Heuristic heuristic) {
  return c.assembled ? mis_weights(terms, extra, heuristic)
                     : mis_weights(terms, c.s, heuristic, extra);
}

/// What a broken twin of the naive implementation leaves out.
enum class Flaw { none, no_direct, no_eta };

/// Density of vertex i, in its measure, made by a walk from the light or from the camera.
struct NaiveDensities {
  std::vector<double> from_light, from_camera;
  double direct = 0;
};

/// d(solid angle at `from`) / d(measure of `to`).
inline double solid_angle_per_measure(const SurfacePoint& from, const SurfacePoint& to) {
  if (to.infinite()) return 1;
  const Vec3 d = to.p - from.p;
  const double cosine = to.kind == PointKind::surface ? std::abs(dot(to.ng, d)) / length(d) : 1;
  return cosine / dot(d, d);
}

/// The probability of a reflection is the same from both sides, but close to total reflection it is
/// badly conditioned, and a path's directions are mirror images only up to rounding. A BSDF may
/// compute it once or from each side.
enum class Mirrors { ask_twice, ask_once };

/// The probability that a walk from `from` stops at x.
inline double naive_stop(const Scene& scene, const Vertex& x, const Vertex& from) {
  if (x.at.shape == SurfacePoint::no_shape) return 1;
  const Vec3 w = x.at.shading.to_local(direction(x.at, from.at));
  const double passes = scene.bsdf(x.at).passage(x.at, w).probability;
  return scene.emitter(x.at) ? std::max(1 - passes, 0.5) : 1 - passes;
}
/// What a walk passes on an edge: surfaces, with this probability, and media, whose optical depth
/// counts where walks stop in them.
struct NaivePassage {
  double probability = 1;
  Spectrum depth{0};

  /// The probability that a walk goes along the edge, or its density of stopping at x. A walk with
  /// one of the channels has flown all that was before with the probability `flown`, which changes.
  double arrival(const Scene& scene, const Vertex& x, const Vertex& from, Spectrum& flown) const {
    double before = 0, after = 0;
    const double weights[] = {1. / 3, 1. / 6, 1. / 3, 1. / 6};  // of the lanes; of RGB 1/3
    for (int j = 0; j < Spectrum::lanes; ++j) {
      before += weights[j] * flown[j];
      flown[j] *=
          std::exp(-depth[j]) *
          (x.at.in_medium() ? scene.medium(x.at).at(x.at.p, x.at.wavelength).extinction[j] : 1);
      after += weights[j] * flown[j];
    }
    return probability * after / before * (x.at.in_medium() ? 1 : naive_stop(scene, x, from));
  }
};
/// The medium next to a point, on the side of w.
inline const Medium* naive_medium(const Scene& scene, const SurfacePoint& at, const Vec3& w) {
  if (at.shape != SurfacePoint::no_shape) {
    const auto& [interior, exterior] = scene.shapes()[at.shape]->media();
    if (interior || exterior) return (dot(at.ng, w) > 0 ? exterior : interior).get();
  }
  const bool lens = at.shape == SurfacePoint::no_shape && at.kind == PointKind::surface;
  const MediumIndex index = lens ? scene.camera().surroundings() : at.medium;
  return index == no_medium ? nullptr : &scene.media()[index];
}
/// The extinction along a line: where it varies, summed in the middles of many short steps.
inline Spectrum naive_depth(const Medium& medium, const Vec3& p, const Vec3& w, double distance,
                            double wavelength) {
  const int steps = medium.type == "homogeneous" ? 1 : 250;
  Spectrum depth(0);
  for (int i = 0; i < steps; ++i) {
    const double step = distance / steps;
    const Spectrum sigma =
        medium.at(steps == 1 ? p : p + (i + 0.5) * step * w, wavelength).extinction;
    for (int j = 0; j < Spectrum::lanes; ++j)
      if (sigma[j] > 0) depth[j] += sigma[j] * step;
  }
  return depth;
}
/// Follows edge i from the camera's end.
inline NaivePassage naive_passage(const Scene& scene, const Path& path, int i) {
  const SurfacePoint &a = path[i].at, &b = path[i + 1].at;
  const Vec3 w = direction(b, a);
  const double length = a.infinite() ? infinity : mlt::length(a.p - b.p);
  Ray ray = scene.spawn(b, w, path.time);
  NaivePassage passed;
  const Medium* medium = naive_medium(scene, b, w);
  double gone = 0;
  const auto go_to = [&](double distance) {
    if (medium && medium->stops_walks())
      passed.depth += naive_depth(*medium, b.p + gone * w, w, distance - gone, path.wavelength);
    gone = distance;
  };
  SurfacePoint at;
  const double before_surface = a.in_medium() ? length : length * (1 - 1e-3) - 1e-4;
  while (scene.intersect(ray, at) && mlt::length(at.p - b.p) < before_surface) {
    const double passes = scene.bsdf(at).passage(at, at.shading.to_local(w)).probability;
    passed.probability *= scene.emitter(at) ? std::min(passes, 0.5) : passes;
    go_to(mlt::length(at.p - b.p));
    at.medium = no_medium;
    if (const auto& [interior, exterior] = scene.shapes()[at.shape]->media(); interior || exterior)
      medium = naive_medium(scene, at, w);
    ray = scene.spawn(at, w, path.time);
  }
  go_to(length);
  return passed;
}

inline NaiveDensities naive_densities(const Scene& scene, const Path& path, Flaw flaw = Flaw::none,
                                      Mirrors mirrors = Mirrors::ask_twice) {
  const int k = path.edges();
  NaiveDensities p;
  p.from_light.assign(k + 1, 0);
  p.from_camera.assign(k + 1, 0);
  const Vertex &x0 = path[0], &xk = path[k];
  const Emitter& emitter = *scene.emitters().at(x0.emitter);
  const double choice = scene.emitter_probability(x0.emitter);
  p.from_light[0] = choice * emitter.pdf_position(x0.at);
  p.direct =

      flaw == Flaw::no_direct ? p.from_light[0]
                              : scene.emitter_probability_for(x0.emitter, path[1].at.p) *
                                    emitter.pdf_direct(path[1].at.p, x0.at);
  p.from_camera[k] = scene.camera().pdf_position(xk.at);

  const auto cosine = [](const SurfacePoint& at, const Vec3& w) {
    return at.kind == PointKind::surface ? std::abs(dot(at.ng, w)) : 1.0;
  };
  const Vec3 w0 = direction(x0.at, path[1].at);
  p.from_light[1] =
      emitter.pdf_ray(x0.at, w0) *
      (x0.at.infinite() ? cosine(path[1].at, w0)
                        : cosine(x0.at, w0) * solid_angle_per_measure(x0.at, path[1].at));
  const Vec3 wk = direction(xk.at, path[k - 1].at);
  p.from_camera[k - 1] = scene.camera().pdf_direction(xk.at, wk) * cosine(xk.at, wk) *
                         solid_angle_per_measure(xk.at, path[k - 1].at);
  for (int i = 1; i < k; ++i) {
    const SurfacePoint& at = path[i].at;
    const Bsdf& bsdf = scene.bsdf(at);
    const Vec3 world_l = direction(at, path[i - 1].at), world_c = direction(at, path[i + 1].at);
    const Vec3 wl = at.shading.to_local(world_l), wc = at.shading.to_local(world_c);
    const Lobe lobe = path[i].lobe;
    const double to_camera = bsdf.pdf(at, wl, wc, lobe);
    const double to_light = lobe == Lobe::reflection && mirrors == Mirrors::ask_once
                                ? to_camera
                                : bsdf.pdf(at, wc, wl, lobe);
    const double out = solid_angle_per_measure(at, path[i + 1].at);
    const double back = solid_angle_per_measure(at, path[i - 1].at);
    if (lobe == Lobe::smooth) {
      p.from_light[i + 1] = to_camera * out;
      p.from_camera[i - 1] = to_light * back;
    } else {
      // One delta, in projected solid angle of the camera side: the other side's carries the ratio
      // of projected solid angles, n_l^2 |cos l| d(wl) = n_c^2 |cos c| d(wc), with cosines against
      // the normal about which it reflects or refracts.
      const double gl = std::abs(dot(at.ng, world_l)), gc = std::abs(dot(at.ng, world_c));
      double ratio = 1;
      if (lobe == Lobe::transmission && flaw != Flaw::no_eta)
        ratio = sqr(bsdf.relative_eta(at, wl));
      const Vec3 n = bsdf.delta_normal(at, wl);
      ratio *= std::abs(dot(wl, n) / dot(wc, n)) * (gc / gl);
      p.from_light[i + 1] = to_camera * gc * out;
      p.from_camera[i - 1] = to_light * ratio * gl * back;
    }
  }
  if (!scene.has_passages()) return p;
  std::vector<NaivePassage> passed;
  for (int i = 0; i < k; ++i) passed.push_back(naive_passage(scene, path, i));
  Spectrum flown(1);
  for (int i = 0; i + 1 < k; ++i)
    p.from_light[i + 1] *= passed[i].arrival(scene, path[i + 1], path[i], flown);
  flown = Spectrum(1);
  for (int i = k - 1; i >= 0; --i)
    p.from_camera[i] *= passed[i].arrival(scene, path[i], path[i + 1], flown);
  return p;
}

/// Whether technique s can make the path at all.
inline bool naive_can_sample(const Scene& scene, const Path& path, int s,
                             const BidirectionalSettings& settings) {
  const int k = path.edges();
  if (s == 0) return !scene.emitters()[path[0].emitter]->delta();
  if (s == k + 1) return settings.light_image && !scene.camera().delta_position();
  if (s == k && !settings.light_image) return false;
  return path[s - 1].lobe == Lobe::smooth && path[s].lobe == Lobe::smooth;
}

/// p_{s,t} of all techniques, as plain products.
inline std::vector<double> naive_technique_densities(const Scene& scene, const Path& path,
                                                     const BidirectionalSettings& settings,
                                                     Flaw flaw = Flaw::none) {
  const NaiveDensities p = naive_densities(scene, path, flaw);
  const int k = path.edges();
  std::vector<double> densities(k + 2, 0.0);
  for (int s = 0; s <= k + 1; ++s) {
    if (!naive_can_sample(scene, path, s, settings)) continue;
    densities[s] = 1;
    for (int i = 0; i < s; ++i)
      densities[s] *= s == 1 && settings.sample_direct ? p.direct : p.from_light[i];
    for (int i = s; i <= k; ++i) densities[s] *= p.from_camera[i];
  }
  return densities;
}

/// Weights of all techniques from their densities.
inline std::vector<double> naive_weights(const std::vector<double>& densities,
                                         Heuristic heuristic) {
  std::vector<double> weights(densities.size(), 0.0);
  if (heuristic == Heuristic::maximum) {
    weights[std::max_element(densities.begin(), densities.end()) - densities.begin()] = 1;
    return weights;
  }
  const double largest = *std::max_element(densities.begin(), densities.end());
  double sum = 0;
  for (size_t s = 0; s < weights.size(); ++s) {
    const double p = densities[s] / largest;
    sum += weights[s] = heuristic == Heuristic::balance ? p : p * p;
  }
  for (double& w : weights) w /= sum;
  return weights;
}

inline double relative_difference(double a, double b) {
  return a == b ? 0 : std::abs(a - b) / std::max(std::abs(a), std::abs(b));
}
inline double relative_difference(const Color& a, const Color& b) {
  return a == b ? 0 : max_component(glm::abs(a - b)) / std::max(max_component(a), max_component(b));
}

/// How far `values` are from f(path), in units of what rounding explains. Rays start off their
/// surface by a small offset, so a walk's own directions belong to vertices that are moved by that
/// offset, or to neighbours that are: the tolerance is 1e-9 plus what ten times such moves, one by
/// one, change in f (moves of neighbours may cancel where the walk's mixture of both does not, and
/// close to total reflection f is steep). Above 1 it is an error.
template <class F>
double excess(const Scene& scene, const Path& path, F&& f, const std::vector<double>& values) {
  const std::vector<double> expected = f(path);
  // A ray is moved again by each surface that it passes.
  const double moves = scene.has_passages() ? 200 : 10;
  std::vector<double> tolerance;
  bool exact = true;
  for (size_t i = 0; i < values.size(); ++i) {
    tolerance.push_back(1e-9 * std::abs(expected[i]));
    exact = exact && std::abs(values[i] - expected[i]) <= tolerance[i];
  }
  if (exact) return 0;
  for (int v = 0; v <= path.edges(); ++v) {
    const SurfacePoint& at = path[v].at;
    if (at.infinite()) continue;
    for (const double side : {-1.0, 1.0})
      for (int next = std::max(v - 1, 0); next <= std::min(v + 1, path.edges()); ++next) {
        if (path[next].at.infinite()) continue;
        Path moved = path;
        const Vec3 off = at.in_medium() ? side * ray_offset * at.ng
                                        : scene.spawn(at, side * at.ng, path.time).o - at.p;
        moved[next].at.p += moves * off;
        const std::vector<double> other = f(moved);
        for (size_t i = 0; i < other.size(); ++i)  // the edges may not be free
          if (!std::isnan(other[i])) tolerance[i] += std::abs(other[i] - expected[i]);
      }
  }
  double worst = 0;
  for (size_t i = 0; i < values.size(); ++i) {
    const double difference = std::abs(values[i] - expected[i]);
    const double ratio = difference == 0 ? 0 : difference / tolerance[i];
    worst = std::isnan(ratio) ? infinity : std::max(worst, ratio);
  }
  return worst;
}

/// The largest of many numbers, and which one it was. A NaN counts as infinite.
struct Worst {
  double value = 0;
  std::string where;
  void add(double x, const std::string& at) {
    if (std::isnan(x)) x = infinity;
    if (x > value) value = x, where = at;
  }
};

inline std::string technique_name(const Scene& scene, const Connection& c, const Path& path) {
  return signature(scene, path) + " by s = " + std::to_string(c.s) + ", t = " + std::to_string(c.t);
}

}  // namespace mlt::test
