#include "mutation/certain_light.h"

#include "base/error.h"
#include "base/parallel.h"
#include "path/path_tracer.h"
#include "path/samplers.h"

#include <cmath>

namespace mlt {
namespace {

/// Walks per cell of the image: one through each of its quarters.
constexpr int walks_per_cell = 4;

/// Whether a walk by delta lobes ends at a light.
bool sees_light(const Scene& scene, const PathRules& rules, const Vec2& raster,
                RandomSampler& sampler, RayCounts& rays) {
  CameraWalk walk(camera_ray(scene.camera(), raster, sampler).ray);
  const Walker walker{scene, walk.ray.time, rays};
  for (int depth = 1; walk.delta; ++depth) {
    SurfacePoint at;
    const bool hit = arrive(walker, sampler, walk, at);
    if (rules.wants(depth)) find_light(scene, walk, hit ? &at : nullptr);
    if (!is_black(walk.radiance)) return true;
    if (!hit || depth == rules.most_edges()) return false;
    if (!consistent_sides(at, -walk.ray.d, rules.strict_normals)) return false;
    if (!scatter(walker, rules, depth, at, VertexNumbers::draw(sampler), walk)) return false;
  }
  return false;
}

}  // namespace

CertainLight::CertainLight(const Raster& raster, uint64_t walks) : cells_{raster, 1, 1} {
  const double cells = static_cast<double>(walks) / walks_per_cell;
  const double columns = std::sqrt(cells * raster.size.x / raster.size.y);
  cells_.columns = std::max(1, static_cast<int>(columns));
  cells_.rows = std::max(1, static_cast<int>(cells / cells_.columns));
  lit_.resize(cells_.count());
}

CertainLight::CertainLight(const Scene& scene, const PathRules& rules, uint64_t walks,
                           uint64_t seed, int threads, const std::atomic<bool>& cancelled)
    : CertainLight(scene.camera().raster(), walks) {
  std::vector<uint8_t> filled(lit_.size());
  parallel_for(threads, filled.size(), [&](uint64_t cell) {
    if (cancelled) return;
    Rng rng(seed, Purpose::certain_light, cell);
    RandomSampler sampler(rng);
    RayCounts rays;
    const Vec2 corner(cell % cells_.columns, cell / cells_.columns);
    int lights = 0;
    for (int i = 0; i < walks_per_cell; ++i) {
      const Vec2 quarter(i % 2, i / 2);
      const Vec2 u =
          (corner + (quarter + sampler.next2()) * 0.5) / Vec2(cells_.columns, cells_.rows);
      lights += sees_light(scene, rules, cells_.raster.sample(u), sampler, rays);
    }
    filled[cell] = 2 * lights >= walks_per_cell;
  });
  // the edges of visible lights are in the neighbours of filled cells
  for (int y = 0; y < cells_.rows; ++y)
    for (int x = 0; x < cells_.columns; ++x)
      if (filled[cells_.index(x, y)])
        cells_.for_neighbours(x, y, [&](int u, int v) { lit_[cells_.index(u, v)] = true; });
}

CertainLight::CertainLight(const Raster& raster, uint64_t walks, std::vector<uint8_t> cells)
    : CertainLight(raster, walks) {
  if (cells.size() != lit_.size())
    throw RenderError("the saved cells of certain light are not as many as the image has");
  lit_ = std::move(cells);
}

}  // namespace mlt
