// What a material brings to the shapes that have it: a medium inside, and a light.
#pragma once

#include "base/registry.h"
#include "scene/bsdf/bsdf.h"
#include "scene/emitter/emitter.h"
#include "scene/medium/medium.h"

namespace mlt {

/// The medium of bsdf.inside(), which is there.
MediumPtr medium_inside(const Bsdf& bsdf, const Registry& registry, const Location& where);
/// An area light of bsdf.glow(), which is there, for one shape.
EmitterPtr light_of(const Bsdf& bsdf, const Registry& registry, const Location& where);

}  // namespace mlt
