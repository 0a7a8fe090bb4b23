// The nearest surfaces along the rays of many paths.
#pragma once

#include "math/lanes.h"
#include "scene/accel/accel.h"

#include <algorithm>

namespace mlt {

/// Traces the first `count` rays in packets. exact(i) is the i-th ray in double precision and
/// time(i) its time; each is called where the accelerator needs it. `coherent`: adjacent rays are
/// similar.
template <int size, class Exact, class Time>
void find_wave_hits(const Accel& accel, int count, const VectorLanes<size>& o,
                    const VectorLanes<size>& d, Exact&& exact, Time&& time, bool coherent,
                    PacketHits* found) {
  const bool wants_exact = accel.wants_exact_rays(), moves = accel.moves();
  for (int begin = 0; begin < count; begin += RayPacket::size) {
    RayPacket packet(std::min(RayPacket::size, count - begin));
    packet.set_lines(&o.x[begin], &o.y[begin], &o.z[begin], &d.x[begin], &d.y[begin], &d.z[begin]);
    packet.set_endless();
    const Ray* exact_rays[RayPacket::size];
    for (int i = 0; wants_exact && i < packet.count; ++i) exact_rays[i] = &exact(begin + i);
    for (int i = 0; moves && i < packet.count; ++i) packet.time[i] = time(begin + i);
    accel.intersect(packet, exact_rays, coherent, found[begin / RayPacket::size]);
  }
}

}  // namespace mlt
