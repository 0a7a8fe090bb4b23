// The way of the walks of a wave through media, and through surfaces that light passes.
#include "wave/subpath_wave.h"

namespace mlt {

void SubpathWave::follow_legs(RayCounts& rays) {
  legs_.follow(
      *scene_, live_, [&](int walk) { return hit(walk); }, [&](int walk) { return medium_[walk]; },
      [&](int walk, WaveLeg& leg) {
        leg.ray = exact_ray(walk);
        leg.u = numbers_.read(leg_, walk);
      },
      rays);
}

/// Takes what a walk has passed on the way to its next vertex (Subpath::pass): `at`, or (nullptr)
/// where nothing is passed and there is no medium. False if that lets no light through.
bool SubpathWave::pass_leg(int i, int place, const SurfacePoint* at) {
  const int walk = begin_ + i;
  transmitted_[i] = Spectrum(1);
  const WaveLeg* leg = this->leg(walk);
  if (!leg) return true;
  const Passage& passed = leg->passed;
  if (passed.is_blocked()) return false;
  const double passes =
      (at ? scene_->arrival(passed, *at, leg->ray.d) : Scene::arrival(passed)).probability();
  transmitted_[i] = passed.transmittance / passes;
  throughput_[walk] *= transmitted_[i];
  pdf_[walk] *= static_cast<float>(passes);
  if (from_light_ || place > 1) stops_back_[walk] *= Scene::arrival(passed).probability();
  if (!from_light_) certainty_[walk] *= passes;
  medium_[walk] = leg->ray.medium;
  return true;
}

/// Finds a vertex in a medium.
void SubpathWave::find_in_medium(int i, int place, const WaveLeg& leg) {
  const SurfacePoint at = Scene::medium_point(leg.ray, *leg.stop);
  if (!pass(i, place, &at)) return;
  certainty_[begin_ + i] = 0;
  find_light(begin_ + i, place, at);
  add_single(i, at);
}

/// What arrive() does, for vertices that are computed alone, in double precision: in media they may
/// be near each other.
void SubpathWave::arrive_alone() {
  for (int i = 0; i < count_; ++i) {
    if (!single_[i]) continue;
    const WalkVertex& x = single_[i]->x;
    const int walk = begin_ + i;
    const double per_area =
        abs_cos(x.vertex.at, x.towards_previous) / distance2(walk, x.vertex.at.p);
    if (x.vertex.at.in_medium()) cosine_to_previous_[i] = 1;
    forward_here_[i] = pdf_[walk] * per_area;
    G_[i] = cosine_[walk] * per_area;
  }
}

/// Sets what a walk from the other end needs to stop where the walk has left.
void SubpathWave::set_back(int walk, const SurfacePoint& from) {
  stops_back_[walk] = scene_->arrival({}, from, -ray_[walk].d).probability();
}

}  // namespace mlt
