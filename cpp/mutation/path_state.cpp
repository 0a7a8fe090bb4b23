#include "mutation/path_state.h"

namespace mlt {
namespace {

template <class T>
void splice(const std::vector<T>& x, int count, const Edit& edit, std::vector<T>& y) {
  y.resize(count + edit.shift());
  const int after = edit.last + 1;
  std::copy_n(x.data(), std::min(edit.first, count), y.data());
  if (after < count) std::copy_n(x.data() + after, count - after, y.data() + after + edit.shift());
}

}  // namespace

void splice(const PathState& x, const Edit& edit, PathState& y) {
  const int count = x.edges() + 1;
  splice(x.path.vertices, count, edit, y.path.vertices);
  y.path.time = x.path.time;
  y.path.wavelength = x.path.wavelength;
  splice(x.terms.at, count, edit, y.terms.at);
  if (!x.terms.passages.empty()) splice(x.terms.passages, count, edit, y.terms.passages);
  y.terms.direct = x.terms.direct;
  y.terms.raster = x.terms.raster;
  y.terms.light_can_be_hit = x.terms.light_can_be_hit;
  y.terms.camera_can_be_hit = x.terms.camera_can_be_hit;
  y.terms.light_in_medium = x.terms.light_in_medium;
}

}  // namespace mlt
