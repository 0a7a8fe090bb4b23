// Targets of the laboratory that run without Python. None needs to be normalised.
#pragma once

#include "lab/lab.h"

#include <memory>

namespace mlt::lab {

using TargetPtr = std::shared_ptr<Target<Point>>;

/// The lecture's example: f(x) = (x - 1/2)^2 on [0, 1], 0 outside; its integral is 1/12.
TargetPtr parabola();

/// f(i) = values[i] on the states 0 ... n - 1.
TargetPtr table(std::vector<double> values);

/// Piecewise constant: the value of the pixel that (x, y) falls into, rows from the top; 0 outside.
TargetPtr image(std::vector<double> pixels, size_t width);

/// A sum of normal densities with weights; one mean (a point) and one standard deviation each.
TargetPtr normals(std::vector<Point> means, std::vector<double> deviations,
                  std::vector<double> weights);

}  // namespace mlt::lab
