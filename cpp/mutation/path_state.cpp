#include "mutation/path_state.h"

namespace mlt {
namespace {

template <class T>
void splice(const std::vector<T>& x, const Edit& edit, std::vector<T>& y) {
  y.resize(x.size() + edit.shift());
  std::copy(x.begin(), x.begin() + std::min<size_t>(edit.first, x.size()), y.begin());
  std::copy(x.begin() + std::min<size_t>(edit.last + 1, x.size()), x.end(),
            y.begin() + std::min<size_t>(edit.first + edit.inserted, y.size()));
}

TermSettings term_settings(const MutationSettings& settings) {
  return {true, settings.strict_normals, settings.near_specular};
}

void finish(const Scene& scene, const MutationSettings& settings, PathState& x) {
  x.target = 0;
  if (x.edges() < settings.min_depth) return;
  if (x.edges() == 1 &&
      (settings.hide_emitters || !(x.terms.light_can_be_hit || x.terms.camera_can_be_hit)))
    return;
  x.rgb = contribution(x.terms);
  const double target = target_luminance(x.rgb);
  if (!(target > 0)) {
    if (std::isnan(target)) x.target = target;
    return;
  }
  const auto raster = raster_position(scene, x.path);
  if (!raster) return;
  x.raster = *raster;
  x.target = settings.map ? target * (*settings.map)(x.raster) : target;
}

}  // namespace

void splice(const PathState& x, const Edit& edit, PathState& y) {
  splice(x.path.vertices, edit, y.path.vertices);
  y.path.time = x.path.time;
  splice(x.terms.at, edit, y.terms.at);
  y.terms.direct = x.terms.direct;
  y.terms.light_can_be_hit = x.terms.light_can_be_hit;
  y.terms.camera_can_be_hit = x.terms.camera_can_be_hit;
}

void evaluate(const Scene& scene, const MutationSettings& settings, int first, int last,
              PathState& x) {
  const int k = x.edges(), from = std::max(0, first - 1), to = std::min(k, last + 1);
  update_terms(scene, x.path, term_settings(settings), from, to, x.terms);
  finish(scene, settings, x);
}

void evaluate(const Scene& scene, const MutationSettings& settings, PathState& x) {
  compute_terms(scene, x.path, term_settings(settings), x.terms);
  finish(scene, settings, x);
}

}  // namespace mlt
