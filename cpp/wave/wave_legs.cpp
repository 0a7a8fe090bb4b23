#include "wave/wave_legs.h"

namespace mlt {
namespace {

/// Follows a leg up to its next surface, and through it; false if it stops before or there.
bool passes(const Scene& scene, WaveLeg& leg) {
  const bool meets = leg.hit.shape != SurfacePoint::no_shape;
  if (leg.ray.medium != no_medium) {
    const double distance = meets ? leg.ray.before + leg.hit.t : leg.ray.t_max;
    leg.stop = fly(scene.media()[leg.ray.medium], leg.ray, distance, leg.u, leg.passed);
  }
  if (leg.in_medium() || !meets || !scene.has_passage(leg.hit.shape)) return false;
  SurfacePoint at;
  scene.find_surface_point(leg.ray, leg.hit, at);
  const Passage here = scene.passage(at, leg.ray.d);
  if (!(leg.u < here.probability)) return false;
  leg.u /= here.probability;
  leg.passed *= here;
  leg.ray = scene.beyond(leg.ray, at);
  return true;
}

}  // namespace

void WaveLegs::follow_all(const Scene& scene, RayCounts& rays) {
  going_on_.clear();
  for (WaveLeg& leg : legs_)
    if (passes(scene, leg)) going_on_.push_back(&leg);
  while (!going_on_.empty()) {
    intersect(scene, rays);
    const auto ended = [&](WaveLeg* leg) { return !passes(scene, *leg); };
    going_on_.erase(std::remove_if(going_on_.begin(), going_on_.end(), ended), going_on_.end());
  }
}

void WaveLegs::intersect(const Scene& scene, RayCounts& rays) {
  rays.count_intersect(going_on_.size());
  for (size_t begin = 0; begin < going_on_.size(); begin += RayPacket::size) {
    const size_t count = std::min(size_t{RayPacket::size}, going_on_.size() - begin);
    RayPacket packet;
    const Ray* exact[RayPacket::size];
    for (size_t i = 0; i < count; ++i) {
      exact[i] = &going_on_[begin + i]->ray;
      packet.add(*exact[i]);
    }
    packet.set_endless();
    PacketHits hits;
    scene.accel().intersect(packet, exact, false, hits);
    for (size_t i = 0; i < count; ++i) going_on_[begin + i]->hit = hits.hit(static_cast<int>(i));
  }
}

}  // namespace mlt
