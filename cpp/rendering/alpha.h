// Alpha: how much each pixel hides of what lies behind the scene, for compositing. It is rendered
// apart from the image, so every integrator has it.
#pragma once

#include "image/image.h"
#include "scene/scene.h"

namespace mlt {

/// Numbers of camera rays per pixel: in all tiles, and in those where these see different things.
inline constexpr uint64_t fewest_alpha_samples = 16, alpha_samples = 64;

/// The share of the light from behind the scene along a ray that does not come through: 1 where
/// there is a surface, less for masks, thin glass and media.
double opacity_along(const Scene& scene, Ray ray);

/// An image of one channel from 0 to 1, reconstructed with the film's filter. A background that can
/// be seen hides all behind it. The same for any number of threads.
Image render_alpha(const ScenePtr& scene, bool hide_emitters, uint64_t seed, int threads);

}  // namespace mlt
