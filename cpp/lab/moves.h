// Moves of the laboratory that run without Python.
#pragma once

#include "lab/lab.h"

#include <memory>

namespace mlt::lab {

using MovePtr = std::shared_ptr<Move<Point>>;

enum class WalkShape { uniform, normal };

/// y = x + size (u - 1/2) in each coordinate, or x + size N(0, 1). Symmetric. One size for all
/// coordinates, or one for each.
MovePtr random_walk(std::vector<double> size, WalkShape shape);

/// How an adaptive walk learns (Robbins & Monro 1951; Andrieu & Thoms 2008): after its i-th
/// proposal, log(scale) += rate i^-decay (acceptance - goal). With decay = 0 the scale depends on
/// the latest states for ever, and the chain no longer samples the target.
struct Adaptation {
  double goal = 0.44, rate = 1, decay = 0.6;
};

/// A random walk whose size is multiplied by a learnt scale.
MovePtr adaptive_walk(std::vector<double> size, WalkShape shape, const Adaptation& adaptation);

/// y uniform in a box, whatever x is.
MovePtr uniform(Point low, Point high);

/// States 0 ... n - 1; row x of the matrix holds q(x -> y).
MovePtr discrete(const std::vector<std::vector<double>>& matrix);

}  // namespace mlt::lab
