// Layers that show what the camera sees first (arbitrary output variables): material, normals,
// depth and so on, for compositing and denoising. They are rendered apart from the image, so every
// integrator has them.
#pragma once

#include "base/parallel.h"
#include "rendering/integrator.h"

namespace mlt {

/// What a layer shows of the first surface. Means over the pixel, but for the indices: those are of
/// the ray through its middle. 0 where there is no surface; indices are -1 there.
enum class AovKind {
  albedo,       ///< Reflectance of the material, RGB.
  depth,        ///< Distance from the camera along the ray.
  position,     ///< In the world.
  uv,           ///< Texture coordinates, and 0.
  geo_normal,   ///< Of the geometry, unit before the mean is taken.
  sh_normal,    ///< Interpolated between vertices, the same.
  shape_index,  ///< In the order of the scene; of an instance, that of the instance.
  prim_index    ///< Triangle of the mesh.
};

struct Aov {
  std::string name;  ///< Of the layer.
  AovKind kind;
};

/// Reads "albedo, n:sh_normal, ...": kinds, each with a name before it if it is to have another
/// one. Throws UsageError for an unknown kind, or a name that is empty or given twice.
std::vector<Aov> parse_aovs(const std::string& list);

/// Camera rays per pixel that layers are the mean of.
inline constexpr int aov_samples = 16;

/// Images of 3 channels, of 1 for depth and indices. The same for any number of threads.
std::vector<NamedImage> render_aovs(const Scene& scene, const std::vector<Aov>& aovs, uint64_t seed,
                                    int threads);

}  // namespace mlt
