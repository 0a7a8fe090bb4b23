#include "path_factor.h"

#include "job/output.h"
#include "path/path_terms.h"

#include <fmt/format.h>

#include <cmath>
#include <regex>

namespace mlt::python {
namespace {

using Factor = PathTarget::PathFactor;

Factor of_class(const std::string& paths) {
  try {
    const std::regex wanted(paths);
    return [wanted](const PathState& x) {
      return std::regex_match(signature(x.terms), wanted) ? 1.0 : 0.0;
    };
  } catch (const std::regex_error& error) {
    throw UsageError(
        fmt::format("paths is '{}', which is no regular expression for signatures "
                    "such as LSDE: {}",
                    paths, error.what()));
  }
}

/// L*^(power - 1); 0 where L* is too small for it.
Factor tempering(double power) {
  if (!(power > 0 && power < infinity))
    throw UsageError(fmt::format("power is {:g}, but should be above 0", power));
  return [power](const PathState& x) {
    const double factor = std::pow(x.brightness(), power - 1);
    return std::isfinite(factor) ? factor : 0;
  };
}

Factor of_image(const py::object& weight, const Vec2i& size) {
  const Doubles image = Doubles::ensure(weight);
  if (!image) PyErr_Clear();
  if (!image || image.ndim() != 2 || image.shape(0) != size.y || image.shape(1) != size.x)
    throw UsageError(
        fmt::format("weight should be a function of a LightPath, or an array of the shape ({}, {})",
                    size.y, size.x));
  const std::vector<double> values(image.data(), image.data() + image.size());
  for (const double value : values)
    if (!(value >= 0 && value < infinity))
      throw UsageError(
          fmt::format("weight has a pixel of {:g}, but should not be negative", value));
  return [values, size](const PathState& x) {
    const Vec2i pixel = glm::clamp(Vec2i(glm::floor(x.raster)), Vec2i(0), size - 1);
    return values[size_t(pixel.y) * size_t(size.x) + size_t(pixel.x)];
  };
}

Factor of_function(const LoadedPtr& scene, const py::object& weight, bool strict_normals) {
  const std::shared_ptr<py::object> held = hold(weight);
  return [scene, held, strict_normals](const PathState& x) {
    const AcquiredGil gil = acquire_gil();
    const py::object path = py::cast(light_path(scene, x, strict_normals));
    const py::object returned = (*held)(path);
    const double value = PyFloat_AsDouble(returned.ptr());
    if (value >= 0 && value < infinity) return value;
    PyErr_Clear();
    throw UsageError("weight(x) is " + std::string(py::repr(returned)) +
                     " for x = " + std::string(py::repr(path)) +
                     "; it must be a finite number that is not negative");
  };
}

}  // namespace

PathTarget::PathFactor path_factor(const LoadedPtr& scene, const FactorSettings& settings,
                                   bool strict_normals) {
  std::vector<Factor> factors;
  if (settings.paths) factors.push_back(of_class(*settings.paths));
  if (settings.power != 1) factors.push_back(tempering(settings.power));
  if (PyCallable_Check(settings.weight.ptr()) != 0)
    factors.push_back(of_function(scene, settings.weight, strict_normals));
  else if (!settings.weight.is_none())
    factors.push_back(of_image(settings.weight, image_size(*scene->scene)));
  if (factors.empty()) return nullptr;
  return [factors](const PathState& x) {
    double product = 1;
    for (const Factor& factor : factors)
      if (product > 0) product *= factor(x);
    return product;
  };
}

}  // namespace mlt::python
