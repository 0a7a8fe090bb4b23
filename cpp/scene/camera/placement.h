// Where a camera is, and how it moves while its shutter is open.
#pragma once

#include "base/params.h"
#include "scene/camera/camera.h"
#include "scene/transform/motion.h"

namespace mlt {

/// The position and the axes of a camera, and its shutter.
struct Placement {
  Vec3 position;  ///< Position and axes are those when the shutter opens.
  Frame axes;
  Shutter shutter;
  Motion motion;
};

/// The parameters of the shutter.
std::vector<Parameter> shutter_parameters();
Shutter read_shutter(Params& params);
/// The parameters of the placement of a camera.
std::vector<Parameter> placement_parameters();
Placement read_placement(Params& params);

class PlacedCamera : public Camera {
 public:
  explicit PlacedCamera(const Placement& placement);

 protected:
  /// The middle of the lens and the axes of camera space.
  struct Pose {
    Vec3 position;
    Frame axes;
  };
  Pose pose(double time) const {
    if (!motion_.moves()) return pose_;
    return moved_pose(time);
  }
  bool moves() const { return motion_.moves(); }

  Pose pose_;  ///< Pose when the shutter opens.

 private:
  Pose moved_pose(double time) const;

  Motion motion_;
};

}  // namespace mlt
