// A shape that is an equation, not triangles: rays meet it in double precision.
#pragma once

#include "scene/shape.h"

#include <optional>

namespace mlt {

class AnalyticShape : public Shape {
 public:
  /// The nearest intersection with t_min <= t <= t_max. `d` has unit length.
  virtual std::optional<double> intersect(const Vec3& o, const Vec3& d, double t_min,
                                          double t_max) const = 0;

  const AnalyticShape* as_analytic() const final { return this; }
};

}  // namespace mlt
