#include "scene/medium/media.h"

#include <algorithm>

namespace mlt {

void Media::add(const std::vector<ShapePtr>& shapes, const std::vector<uint32_t>& solids) {
  for (const ShapePtr& shape : shapes) {
    const auto& [interior, exterior] = shape->media();
    boundaries_.push_back({add(exterior), add(interior), interior || exterior});
  }
  solids_ = solids;
  for (const uint32_t shape : solids) boundaries_[shape].exists = true;
}

MediumIndex Media::add(const MediumPtr& medium) {
  if (!medium) return no_medium;
  const auto found = std::find(all_.begin(), all_.end(), medium);
  const auto index = found - all_.begin();
  if (index == no_medium)
    throw SceneError(at(medium->where, "this is one medium too many; {} are the most", no_medium));
  if (found == all_.end()) all_.push_back(medium);
  return static_cast<MediumIndex>(index);
}

bool Media::any_coloured() const {
  return std::any_of(all_.begin(), all_.end(), [](const MediumPtr& medium) {
    return medium->stops_walks() && !medium->grey();
  });
}

}  // namespace mlt
