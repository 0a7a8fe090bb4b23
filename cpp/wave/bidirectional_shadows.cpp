// The shadow rays of a bidirectional wave, and the light that comes through what is on their way.
#include "wave/bidirectional_wave.h"

namespace mlt {

void BidirectionalWave::find_shadows(RayCounts& rays) {
  rays.count_occluded(shadows_.count());
  shadows_.trace(
      scene_->accel(), [&](int light) { return time(lights_found_[light].sample); },
      [&](int shadow, const Color&, double) {
        if (scene_->has_media() && waiting_[shadow].medium != no_medium) return pass(shadow, false);
        take(shadows_.path(shadow));
      },
      [&](int shadow) { pass(shadow, true); });
  waiting_.clear();
}

/// Takes light through media, and through `surfaces`. They change its weight, too, since a walk may
/// stop there.
void BidirectionalWave::pass(int shadow, bool surfaces) {
  const int found = shadows_.path(shadow);
  Light& light = lights_found_[found];
  const Waiting& waiting = waiting_[shadow];
  Ray ray = shadows_.ray(shadow, time(light.sample));
  ray.wavelength = wavelength_[light.sample];
  ray.medium = waiting.medium;
  const Passage seen = scene_->pass(ray, surfaces);
  if (seen.is_blocked()) return;
  const auto& [weighted, dispersed, scaled, fixed, medium] = waiting;
  const double goes = Scene::arrival(seen).probability(),
               mis = mis_weight(1, beta_.over(scaled, goes), fixed);
  light.weighted = recorded(weighted * seen.transmittance * (mis / mis_weight(1, scaled, fixed)),
                            ray.wavelength, dispersed);
  light.certainty *= goes;
  take(found);
}

}  // namespace mlt
