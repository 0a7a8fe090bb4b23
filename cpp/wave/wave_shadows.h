// Shadow rays of many paths: light that reaches their vertices unless it is blocked.
#pragma once

#include "math/lanes.h"
#include "scene/scene.h"

#include <array>

namespace mlt {

class WaveShadows {
 public:
  int count() const { return count_; }
  /// Adds a shadow ray: the path receives `share` of `radiance` unless the ray is blocked between
  /// its ends.
  void add(int path, const Color& radiance, double share, const Vec3f& o, const Vec3f& w,
           float length) {
    o_.set(count_, o);
    w_.set(count_, w);
    length_[count_] = length;
    path_[count_] = path;
    share_[count_] = share;
    radiance_[count_++] = radiance;
  }

  int path(int i) const { return path_[i]; }
  Ray ray(int i, double time) const { return {Vec3(o_[i]), Vec3(w_[i]), time, length_[i]}; }

  /// Calls receive(i, radiance, share) for the i-th ray if it is not blocked, or pass(i) where it
  /// passes surfaces, and clears all rays; time(path) is the time of a path.
  template <class Time, class Receive, class Pass>
  void trace(const Accel& accel, Time&& time, Receive&& receive, Pass&& pass) {
    for (int begin = 0; begin < count_; begin += RayPacket::size) {
      RayPacket packet(std::min(RayPacket::size, count_ - begin));
      packet.set_lines(&o_.x[begin], &o_.y[begin], &o_.z[begin], &w_.x[begin], &w_.y[begin],
                       &w_.z[begin]);
      for (int i = 0; i < RayPacket::size; ++i) packet.t_max[i] = length_[begin + i];
      for (int i = 0; accel.moves() && i < packet.count; ++i)
        packet.time[i] = time(path_[begin + i]);
      const auto [blocked, passed] = accel.occluded(packet);
      for (int i = 0; i < packet.count; ++i) {
        if (blocked >> i & 1) continue;
        if (passed >> i & 1)
          pass(begin + i);
        else
          receive(begin + i, radiance_[begin + i], share_[begin + i]);
      }
    }
    count_ = 0;
  }

 private:
  int count_ = 0;
  VectorWave o_, w_;
  Wave<float> length_;
  Wave<int> path_;
  Wave<Color> radiance_;
  Wave<double> share_;
};

}  // namespace mlt
