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

}  // namespace

void splice(const PathState& x, const Edit& edit, PathState& y) {
  splice(x.path.vertices, edit, y.path.vertices);
  y.path.time = x.path.time;
  splice(x.terms.at, edit, y.terms.at);
  y.terms.direct = x.terms.direct;
  y.terms.raster = x.terms.raster;
  y.terms.light_can_be_hit = x.terms.light_can_be_hit;
  y.terms.camera_can_be_hit = x.terms.camera_can_be_hit;
}

}  // namespace mlt
