// Layers of the surface that a camera ray hits first (arbitrary output variables): material,
// normals, depth and so on, for compositing and denoising. They are rendered apart from the image,
// so every integrator has them.
#pragma once

#include "base/parallel.h"
#include "rendering/integrator.h"

namespace mlt {

/// The quantity of the first surface in a layer. Means over the pixel, but for the indices: those
/// are of the ray through its middle. 0 where there is no surface; indices are -1 there. Media are
/// looked through.
enum class AovKind {
  albedo,         ///< Reflectance of the material, RGB.
  depth,          ///< Distance from the camera along the ray.
  position,       ///< In world space.
  uv,             ///< Texture coordinates, and 0.
  geo_normal,     ///< Geometric normal, of length 1 before the mean is taken.
  sh_normal,      ///< Shading normal, of length 1 before the mean is taken.
  shape_index,    ///< Index in the order of the scene; instances have an index of their own.
  prim_index,     ///< Index of the triangle in its mesh.
  optical_depth,  ///< RGB, of the media before the surface or on all of the ray; may be infinite.
  cryptomatte_object,   ///< Ids and coverages (see cryptomatte.h) of shapes and instances.
  cryptomatte_material  ///< Ids and coverages of their materials.
};

/// Whether it is no quantity of which there are means, but a list of ids.
inline bool is_cryptomatte(AovKind kind) { return kind >= AovKind::cryptomatte_object; }

struct Aov {
  std::string name;  ///< Name of the layer.
  AovKind kind;
  int levels = 6;  ///< How many ids a pixel of a Cryptomatte can have.
};

/// Parses "albedo, n:sh_normal, cryptomatte_object/8, ...": kinds, each with an optional layer name
/// before it, and the number of levels behind those that have some. Throws UsageError for an
/// unknown kind, a wrong number, or a name that is empty or given twice.
std::vector<Aov> parse_aovs(const std::string& list);

/// The quantity of the first surface along a ray, in one channel or in three. `u_leg` decides which
/// surfaces that light passes are passed. Of a Cryptomatte: 1 where there is a surface.
Vec3 aov_value(AovKind kind, const Scene& scene, const Ray& ray, double u_leg);

/// Number of camera rays per pixel for the means of layers.
inline constexpr int aov_samples = 16;

/// Images of 3 channels, of 1 for depth and indices; none of Cryptomattes. The same for any number
/// of threads.
std::vector<NamedImage> render_aovs(const Scene& scene, std::vector<Aov> aovs, uint64_t seed,
                                    int threads);

}  // namespace mlt
