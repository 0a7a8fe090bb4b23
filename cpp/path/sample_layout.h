// The random numbers of each step of a walk, and the order in which they are drawn: that of the
// members. A sampler (path/samplers.h) gives the numbers themselves to one walk, or their places to
// walks that are traced side by side.
#pragma once

#include "math/vec.h"

#include <cstddef>

namespace mlt {

/// The lens position and the time of a walk from the camera, after its raster position.
template <class Pair, class Single = Pair>
struct LensNumbersOf {
  Pair position;
  Single time;

  template <class Sampler>
  static LensNumbersOf draw(Sampler& sampler) {
    return {sampler.next2(), sampler.next()};
  }
};

/// The start of a walk from a light.
template <class Pair, class Single = Pair>
struct LightNumbersOf {
  Pair position, direction;
  Single choice;

  template <class Sampler>
  static LightNumbersOf draw(Sampler& sampler) {
    return {sampler.next2(), sampler.next2(), sampler.next()};
  }
};

/// Next-event estimation at a vertex.
template <class Pair, class Single = Pair>
struct DirectNumbersOf {
  Pair position;
  Single choice;

  template <class Sampler>
  static DirectNumbersOf draw(Sampler& sampler) {
    return {sampler.next2(), sampler.next()};
  }
  Vec3 for_light() const { return {choice, position}; }
};

/// Light along a leg (approach.h).
template <class Pair, class Single = Pair>
struct ApproachNumbersOf {
  DirectNumbersOf<Pair, Single> light;
  Single distance;

  template <class Sampler>
  static ApproachNumbersOf draw(Sampler& sampler) {
    return {DirectNumbersOf<Pair, Single>::draw(sampler), sampler.next()};
  }
};

/// A vertex of a subpath, where the walk goes on, or a direction by refracted_light.h.
template <class Pair, class Single = Pair>
struct StepNumbersOf {
  Pair direction;
  Single lobe, roulette;

  template <class Sampler>
  static StepNumbersOf draw(Sampler& sampler) {
    return {sampler.next2(), sampler.next(), sampler.next()};
  }
  Vec3 for_scattering() const { return {lobe, direction}; }
};

/// A vertex of path tracing: next-event estimation, and the next step.
template <class Pair, class Single = Pair>
struct VertexNumbersOf {
  Pair light, direction;
  Single choice, lobe, roulette;

  template <class Sampler>
  static VertexNumbersOf draw(Sampler& sampler) {
    return {sampler.next2(), sampler.next2(), sampler.next(), sampler.next(), sampler.next()};
  }
  Vec3 for_light() const { return {choice, light}; }
  Vec3 for_scattering() const { return {lobe, direction}; }
};

using LensNumbers = LensNumbersOf<Vec2, double>;
using LightNumbers = LightNumbersOf<Vec2, double>;
using DirectNumbers = DirectNumbersOf<Vec2, double>;
using ApproachNumbers = ApproachNumbersOf<Vec2, double>;
using StepNumbers = StepNumbersOf<Vec2, double>;
using VertexNumbers = VertexNumbersOf<Vec2, double>;

/// How many numbers a step takes.
template <class Numbers>
inline constexpr size_t count_of = sizeof(Numbers) / sizeof(double);

}  // namespace mlt
