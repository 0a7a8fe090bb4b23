// Matrices as scenes write them, row by row, and as the code computes with them.
#pragma once

#include "base/schema.h"
#include "math/vec.h"

namespace mlt {

inline Mat4 from_rows(const Matrix& rows) {
  Mat4 m;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column)
      m[column][row] = rows[static_cast<size_t>(4 * row + column)];
  return m;
}

inline Matrix to_rows(const Mat4& m) {
  Matrix rows;
  for (size_t i = 0; i < 16; ++i) rows[i] = m[static_cast<int>(i % 4)][static_cast<int>(i / 4)];
  return rows;
}

}  // namespace mlt
