#include "mutation/light_path.h"

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
  return {true, settings.strict_normals};
}

void finish(const Scene& scene, const MutationSettings& settings, LightPath& x) {
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

void splice(const LightPath& x, const Edit& edit, LightPath& y) {
  splice(x.path.vertices, edit, y.path.vertices);
  y.path.time = x.path.time;
  splice(x.terms.vertex, edit, y.terms.vertex);
  splice(x.terms.G, edit, y.terms.G);
  splice(x.terms.from_light, edit, y.terms.from_light);
  splice(x.terms.from_camera, edit, y.terms.from_camera);
  splice(x.terms.connectable, edit, y.terms.connectable);
  splice(x.specular, edit, y.specular);
  y.terms.direct = x.terms.direct;
  y.terms.light_can_be_hit = x.terms.light_can_be_hit;
  y.terms.camera_can_be_hit = x.terms.camera_can_be_hit;
}

void evaluate(const Scene& scene, const MutationSettings& settings, int first, int last,
              LightPath& x) {
  const int k = x.edges(), from = std::max(0, first - 1), to = std::min(k, last + 1);
  update_terms(scene, x.path, term_settings(settings), from, to, x.terms);
  for (int i = std::max(1, from); i <= std::min(k - 1, to); ++i)
    x.specular[i] = is_specular(scene, x[i], x[i - 1].at, x[i + 1].at, settings.near_specular);
  x.specular[0] = x.specular[k] = false;
  finish(scene, settings, x);
}

void evaluate(const Scene& scene, const MutationSettings& settings, LightPath& x) {
  compute_terms(scene, x.path, term_settings(settings), x.terms);
  x.specular.resize(x.edges() + 1);
  evaluate(scene, settings, 0, x.edges(), x);
}

}  // namespace mlt
