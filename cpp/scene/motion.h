// Where something is at each moment while the shutter is open.
//
// Between two keys of an animation the parts of M = T Q S change, with the translation T, the
// rotation Q and the stretch S of the polar decomposition (Shoemake & Duff 1992, "Matrix animation
// and polar decomposition"): T and S linearly, Q at a constant angular speed (Shoemake 1985,
// "Animating rotation with quaternion curves"). Before the first key and after the last one nothing
// moves.
//
// A Motion follows that by matrices at equal steps of time, and is linear between them, as the
// accelerator's own motion of instances is: rays are traced through exactly what is shaded. There
// are enough steps that it stays within 1e-4 of the object's size (and of the way that it goes), or
// the 128 that the accelerator allows.
#pragma once

#include "base/params.h"
#include "math/vec.h"
#include "scene/ray.h"

#include <string>
#include <vector>

namespace mlt {

/// What is wrong with an animation, in words; "" if nothing is.
std::string animation_problem(const Animation& animation);

/// What there is of an animation without problems from `open` to `close`: an Animation between
/// these times, or a Matrix if nothing moves.
Value during(const Animation& animation, const Shutter& shutter);

/// Where a shape that moves is made, to be moved from there: where its own space is, mirrored if
/// the animation mirrors.
Mat4 at_rest(const Animation& animation);

class Motion {
 public:
  /// It stands still.
  explicit Motion(const Mat4& rest = Mat4(1)) : steps_{rest} {}
  /// From the first key to the last one; with one key nothing moves.
  explicit Motion(const Animation& animation);

  bool moves() const { return steps_.size() > 1; }
  Mat4 at(double time) const;
  /// At equal distances of time; one if it stands still.
  const std::vector<Mat4>& steps() const { return steps_; }

  /// The same for what is moved by `before` first.
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
/// The same of something that knows itself when the shutter is open.
Motion motion_param(Params& params, const std::string& name, const Shutter& shutter);

}  // namespace mlt
