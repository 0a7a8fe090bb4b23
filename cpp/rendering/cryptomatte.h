// Cryptomatte: layers from which compositors make a matte of any object or material. They hold, for
// each pixel, ids and the shares of the pixel that these cover: Cryptomatte Specification (J.
// Friedman and A. Jones, Psyop, https://github.com/Psyop/Cryptomatte).
#pragma once

#include "io/surface_names.h"
#include "rendering/aov.h"

#include <cstdint>
#include <string>
#include <vector>

namespace mlt {

/// The id of a name: the bits of its hash, as those of a float that is normal (section "Floating
/// point conversion").
uint32_t cryptomatte_id(const std::string& name);
/// The value of a pixel with the bits of an id.
float as_pixel(uint32_t id);

/// The names of the layers of one Cryptomatte, each of which has two ranks in its four channels.
std::vector<std::string> cryptomatte_layers(const Aov& aov);

/// The names in one Cryptomatte, in the order of the scene, each once.
std::vector<std::string> cryptomatte_names(AovKind kind, const SurfaceNames& names);

/// Renders the layers of all Cryptomattes among `aovs`, with the filter of the film. What lies
/// behind masks and thin glass counts by as much as is seen through them. The layers are the same
/// for any number of threads.
std::vector<NamedImage> render_cryptomattes(const Scene& scene, const std::vector<Aov>& aovs,
                                            const SurfaceNames& names, uint64_t seed, int threads);

}  // namespace mlt
