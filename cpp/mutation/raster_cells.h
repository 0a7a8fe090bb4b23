// The image, divided into equal cells.
#pragma once

#include "scene/camera/camera.h"

#include <algorithm>

namespace mlt {

struct RasterCells {
  Raster raster;
  int columns, rows;

  /// Cells of about `pixels` x `pixels` pixels.
  static RasterCells of(const Raster& raster, int pixels) {
    return {raster, std::max(1, (raster.size.x + pixels - 1) / pixels),
            std::max(1, (raster.size.y + pixels - 1) / pixels)};
  }

  size_t count() const { return static_cast<size_t>(columns) * rows; }
  size_t index(int x, int y) const { return static_cast<size_t>(y) * columns + x; }
  size_t at(const Vec2& position) const {
    const Vec2 u = raster.invert(position);
    return index(std::clamp(static_cast<int>(u.x * columns), 0, columns - 1),
                 std::clamp(static_cast<int>(u.y * rows), 0, rows - 1));
  }
  /// Calls body(u, v) for the cell (x, y) and those around it.
  template <class Body>
  void for_neighbours(int x, int y, Body&& body) const {
    for (int v = std::max(0, y - 1); v <= std::min(rows - 1, y + 1); ++v)
      for (int u = std::max(0, x - 1); u <= std::min(columns - 1, x + 1); ++u) body(u, v);
  }
};

}  // namespace mlt
