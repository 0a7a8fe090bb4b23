// A mesh of any size to render and to load.
#pragma once

#include "math/vec.h"

#include <cmath>
#include <filesystem>
#include <fstream>

namespace mlt {

/// A ball with dents, of 4 n^2 triangles, as a binary PLY file.
inline void write_dented_ball(const std::filesystem::path& path, int n) {
  std::ofstream file(path, std::ios::binary);
  const int columns = 2 * n, vertices = (n + 1) * columns;
  file << "ply\nformat binary_little_endian 1.0\nelement vertex " << vertices
       << "\nproperty float x\nproperty float y\nproperty float z\nelement face " << 2 * n * columns
       << "\nproperty list uchar int vertex_indices\nend_header\n";
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j < columns; ++j) {
      const double theta = pi * (i + 0.001) / (n + 0.002), phi = pi * j / n;
      const double r = 0.4 * (1 + 0.05 * std::sin(20 * theta) * std::sin(20 * phi));
      const float p[3] = {float(0.2 + r * std::sin(theta) * std::cos(phi)),
                          float(0.2 + r * std::cos(theta)),
                          float(r * std::sin(theta) * std::sin(phi))};
      file.write(reinterpret_cast<const char*>(p), sizeof p);
    }
  const auto face = [&](int a, int b, int c) {
    const int32_t corners[3] = {a, b, c};
    file.put(3);
    file.write(reinterpret_cast<const char*>(corners), sizeof corners);
  };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < columns; ++j) {
      const int k = (j + 1) % columns;
      face(i * columns + j, i * columns + k, (i + 1) * columns + j);
      face(i * columns + k, (i + 1) * columns + k, (i + 1) * columns + j);
    }
}

}  // namespace mlt
