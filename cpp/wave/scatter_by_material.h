// Scattering at the vertices of a block of paths, those of each material together.
#pragma once

#include "scene/bsdf/bsdf.h"
#include "scene/bsdf/scattering_lanes.h"

namespace mlt {

/// For vertices with `bsdf` (nullptr: it does not support lanes) and `in_lanes` (whether this was
/// done): put(vertex, i) sets the i-th lane, take(vertex, i) reads its results.
template <class Vertex, class Put, class Take>
void scatter_by_material(Vertex* begin, Vertex* end, ScatteringLanes& lanes, Put&& put,
                         Take&& take) {
  for (Vertex* first = begin; first != end; ++first) {
    if (!first->bsdf || first->in_lanes) continue;
    Vertex* chosen[ScatteringLanes::capacity];
    lanes.count = 0;
    for (Vertex* vertex = first; vertex != end; ++vertex) {
      if (vertex->bsdf != first->bsdf) continue;
      chosen[lanes.count] = vertex;
      put(*vertex, lanes.count++);
    }
    first->bsdf->scatter(lanes);
    for (int i = 0; i < lanes.count; ++i) {
      chosen[i]->in_lanes = true;
      take(*chosen[i], i);
    }
  }
}

}  // namespace mlt
