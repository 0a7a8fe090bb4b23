// Scattering at points of one material, side by side in single precision. Directions are local.
#pragma once

#include "base/whole_vectors.h"
#include "math/lanes.h"
#include "scene/surface_point.h"

namespace mlt {

struct ScatteringLanes {
  static constexpr int capacity = block_size;

  int count = 0;
  Block<const SurfacePoint*> at;
  VectorBlock wc, wl;             ///< Towards the camera; towards a light, or (0, 0, 0).
  Block<float> u_lobe, u_x, u_y;  ///< For the sampled direction.

  // The results, with densities in solid angle; 0: nothing is scattered.
  Block<Spectrum> f_light;  ///< The BSDF between wl and wc.
  Block<float> pdf_light;   ///< Density of wl, given wc.
  VectorBlock to;           ///< A direction sampled for wc,
  Block<Spectrum> f;        ///< the BSDF between them,
  Block<float> pdf;         ///< and its density.

  void set_numbers(int i, const Vec3& u) {
    u_lobe[i] = below_one(u.x);
    u_x[i] = below_one(u.y);
    u_y[i] = below_one(u.z);
  }
  /// Fills the lanes up to a multiple of eight.
  void fill_up() {
    for (int i = count; i < whole_vectors(count); ++i) {
      at[i] = at[0];
      wc.set(i, wc[0]);
      wl.set(i, wl[0]);
      u_lobe[i] = u_x[i] = u_y[i] = 0;
    }
  }
};

}  // namespace mlt
