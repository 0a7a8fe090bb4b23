// The transform of a moving object at each time while the shutter is open.
//
// Between two keys of an animation the parts of M = T Q S change, with the translation T, the
// rotation Q and the stretch S of the polar decomposition (Shoemake & Duff 1992, "Matrix animation
// and polar decomposition"): T and S linearly, Q at a constant angular speed (Shoemake 1985,
// "Animating rotation with quaternion curves"). Before the first key and after the last one M is
// constant.
//
// A Motion approximates M by matrices at equal steps of time, and is linear between them, like the
// accelerator's own motion of instances: so the surfaces that are traced are those that are shaded.
// There are enough steps that it stays within 1e-4 of the object's size (and of the length of its
// way), or the 128 that the accelerator allows.
#pragma once

#include "base/params.h"
#include "math/vec.h"
#include "scene/ray.h"

#include <string>
#include <vector>

namespace mlt {

/// The error in an animation, in words; "" if there is none.
std::string animation_problem(const Animation& animation);

/// A valid animation, restricted to the time of the shutter: an Animation, or a Matrix if nothing
/// moves.
Value during(const Animation& animation, const Shutter& shutter);

/// The transform with which a moving shape is made, before it is moved: the identity, or a
/// mirroring if the animation mirrors.
Mat4 at_rest(const Animation& animation);

class Motion {
 public:
  /// A motion that stands still.
  explicit Motion(const Mat4& rest = Mat4(1)) : steps_{rest} {}
  /// The motion from the first key to the last one; with one key nothing moves.
  explicit Motion(const Animation& animation);

  bool moves() const { return steps_.size() > 1; }
  Mat4 at(double time) const;
  /// Transforms at equal steps of time; one if nothing moves.
  const std::vector<Mat4>& steps() const { return steps_; }

  /// The motion after the transform `before`.
  Motion after(const Mat4& before) const;

 private:
  std::vector<Mat4> steps_;
  double open_ = 0, steps_per_time_ = 0;
};

/// The animation that is given for a parameter of type motion, if one is.
const Animation* animation_param(Params& params, const std::string& name);
/// A parameter of type motion, from the first key to the last one; the identity if it has no
/// default and is not given.
Motion motion_param(Params& params, const std::string& name);
/// A parameter of type motion of an object that has its own shutter, as above.
Motion motion_param(Params& params, const std::string& name, const Shutter& shutter);

}  // namespace mlt
