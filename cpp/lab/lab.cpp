#include "lab/lab.h"

#include <fmt/format.h>

namespace mlt::lab {

std::string describe(const Point& x) {
  if (x.size() == 1) return fmt::format("x = {:.6g}", x[0]);
  std::string text = "x = (";
  for (size_t i = 0; i < x.size(); ++i) text += fmt::format("{}{:.6g}", i ? ", " : "", x[i]);
  return text + ")";
}

std::string describe(double number) { return fmt::format("{:.6g}", number); }

}  // namespace mlt::lab
