// A shape that is given by an equation, not triangles: rays are intersected in double precision.
#pragma once

#include "scene/shape/shape.h"

#include <optional>

namespace mlt {

class AnalyticShape : public Shape {
 public:
  /// The nearest intersection with t_min <= t <= t_max. `d` has unit length.
  virtual std::optional<double> intersect(const Vec3& o, const Vec3& d, double t_min,
                                          double t_max) const = 0;

  const AnalyticShape* as_analytic() const final { return this; }

 protected:
  /// The intersections of a line with a quadric, in order, and which of the two are on the shape.
  struct Roots {
    double near, far;
    bool near_counts = true, far_counts = true;

    std::optional<double> nearest(double t_min, double t_max) const {
      if (near_counts && near >= t_min && near <= t_max) return near;
      if (far_counts && far >= t_min && far <= t_max) return far;
      return std::nullopt;
    }
    /// The root that the accelerator has rounded to the float `t`.
    double meant_by(double t) const {
      const bool is_near = t - near <= far - t + 1e-6 * t;
      return near_counts && (is_near || !far_counts) ? near : far;
    }
  };

  /// Sets the extent from bounds(); called at the end of a constructor.
  void set_extent() {
    Vec3 low, high;
    bounds(low, high);
    extent_ = max_component(glm::max(glm::abs(low), glm::abs(high)));
  }

  SurfacePoint point_at(const Vec3& p, const Vec3& ng, const Frame& shading, const Vec2& uv) const {
    SurfacePoint at;
    at.p = p;
    at.ng = ng;
    at.shading = shading;
    at.uv = uv;
    at.extent = extent_;
    at.shape = index_;
    return at;
  }

 private:
  double extent_ = 0;
};

}  // namespace mlt
