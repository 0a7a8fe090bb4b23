// Where light arrives that comes from a light across delta vertices alone, found by walks before
// the render. Seeds of manifold sampling (manifold_sampler.h) follow the walks that have arrived
// near the vertex to be reached (after Fan et al. 2024, "Manifold path guiding for importance
// sampling specular chains"; there the walks are those of earlier samples).
//
// A photon arrives where its last ray meets a smooth surface, and also where this ray comes nearest
// to the lens. For each light the photons of surfaces, and those of the lens, are divided at
// medians into cells of some ten, small where there are many. Photons of a cell count alike,
// whatever they carry.
#pragma once

#include "path/vertex.h"

#include <unordered_map>
#include <vector>

namespace mlt {

/// The end of a walk from a light, and what starts a similar one.
struct ManifoldPhoton {
  Vec3 at;         ///< Where it has arrived.
  Vec3 aim;        ///< Its first delta vertex.
  uint64_t lobes;  ///< See lobes_of().
  int axis = 0;    ///< Where it is a border between others: the axis along which they differ.
};

class ManifoldPhotons {
 public:
  static constexpr size_t most = 1 << 16;  ///< 4 MB; all lights share them.

  /// Photons of one cell.
  struct Cell {
    const ManifoldPhoton* first = nullptr;
    uint64_t count = 0;

    /// The share of photons that came by these lobes.
    double share(uint64_t lobes) const;
  };

  /// Adds a photon from x0 to a vertex of the kind of y, unless there are too many.
  void add(const Vertex& x0, VertexKind y, const ManifoldPhoton& photon);
  /// Divides the photons of each light into cells; to be called once, after the last add(). A
  /// photon at the border of two cells is in neither.
  void divide();

  size_t size() const { return size_; }
  /// The cell of y for the light of x0; empty if it has no photons.
  Cell near(const Vertex& x0, const Vertex& y) const;

 private:
  using Photons = std::unordered_map<uint32_t, std::vector<ManifoldPhoton>>;  ///< By emitter.

  Photons on_surfaces_, at_lens_;
  size_t size_ = 0;
};

}  // namespace mlt
