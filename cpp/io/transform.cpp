#include "io/transform.h"

#include "base/text.h"
#include "io/values.h"
#include "math/frame.h"
#include "scene/transform/matrix_rows.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>

namespace mlt {
namespace {

const std::vector<std::string>& tags() {
  static const std::vector<std::string> names{"translate", "scale",  "rotate",
                                              "lookat",    "lookAt", "matrix"};
  return names;
}

Vec3 vector_of(const Triple& t) { return {t[0], t[1], t[2]}; }

Mat4 rotation(const Element& step) {
  step.expect_only({"x", "y", "z", "value", "angle"});
  const std::string& text = step.require("angle");
  const auto angle = parse_real(text);
  if (!angle) step.fail("has the angle " + quote(text) + ", but it should be a number of degrees");
  const Vec3 axis = vector_of(read_triple(step, 0));
  const double largest = max_component(glm::abs(axis));
  if (largest == 0) step.fail("turns about the axis 0, 0, 0, which has no direction");
  return glm::rotate(Mat4(1), glm::radians(*angle), normalize(axis / largest));
}

Vec3 corner(const Element& step, const std::string& attribute) {
  const std::string& text = step.require(attribute);
  const auto numbers = parse_triple(text);
  if (!numbers)
    step.fail("has " + attribute + " = " + quote(text) +
              ", but it should be three numbers such as 0, 1, 2");
  return vector_of(*numbers);
}

/// The frame whose z axis points from `origin` to `target` and whose y axis is nearest to `up`;
/// x is to the left. Without `up`, any frame about the direction.
Mat4 look_at(const Element& step) {
  step.expect_only({"origin", "target", "up"});
  const Vec3 origin = corner(step, "origin"), target = corner(step, "target");
  const Vec3 up = step.find("up") ? corner(step, "up") : Vec3(0);
  const double distance = length(target - origin);
  if (!(distance > 0)) step.fail("has the same 'origin' and 'target', so it looks nowhere");
  const Vec3 forward = (target - origin) / distance;
  const Vec3 left = cross(up == Vec3(0) ? Frame::around(forward).s : normalize(up), forward);
  if (!(length(left) > 1e-12)) step.fail("has an 'up' along the line of sight; turn it aside");
  const Vec3 x = normalize(left), y = cross(forward, x);
  return {Vec4(x, 0), Vec4(y, 0), Vec4(forward, 0), Vec4(origin, 1)};
}

/// 16 numbers row by row, or 9 for the upper left block.
Mat4 matrix(const Element& step) {
  step.expect_only({"value"});
  const std::string& text = step.require("value");
  const auto numbers = parse_reals(text);
  if (!numbers) step.fail("is " + quote(text) + ", but should be 16 numbers, row by row");
  if (numbers->size() != 16 && numbers->size() != 9)
    step.fail("has " + std::to_string(numbers->size()) + " numbers, but should have 16 (or 9)");
  const int n = numbers->size() == 16 ? 4 : 3;
  Mat4 m(1);
  for (int row = 0; row < n; ++row)
    for (int column = 0; column < n; ++column)
      m[column][row] = (*numbers)[static_cast<size_t>(row * n + column)];
  return m;
}

Mat4 matrix_of(const Element& step) {
  if (step.tag == "rotate") return rotation(step);
  if (step.tag == "matrix") return matrix(step);
  if (step.tag == "lookat" || step.tag == "lookAt") return look_at(step);
  step.expect_only({"x", "y", "z", "value"});
  if (step.tag == "scale") return glm::scale(Mat4(1), vector_of(read_triple(step, 1)));
  return glm::translate(Mat4(1), vector_of(read_triple(step, 0)));
}

}  // namespace

bool is_transform_tag(const std::string& tag) {
  return std::find(tags().begin(), tags().end(), tag) != tags().end();
}

Matrix read_transform(const std::vector<Element>& steps) {
  Mat4 product(1);
  for (const Element& step : steps) {
    if (!is_transform_tag(step.tag))
      step.fail("does not belong in a <transform>" + suggestion(step.tag, tags()));
    product = matrix_of(step) * product;
  }
  return to_rows(product);
}

}  // namespace mlt
