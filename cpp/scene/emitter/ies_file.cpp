#include "scene/emitter/ies_file.h"

#include "base/text.h"
#include "scene/shape/text_scanner.h"

#include <fmt/format.h>

#include <cmath>

namespace mlt {
namespace {

constexpr size_t most_angles = 10'000;
constexpr double most_candela = 1e20;

class IesReader {
 public:
  IesReader(std::string_view bytes, const std::string& name) : text_(bytes, name) {}

  IesProfile read() {
    skip_keywords();
    number("the number of lamps");
    number("the lumens of a lamp");
    double factor = positive("the multiplier of the candelas");
    const size_t rows = count("the number of vertical angles");
    const size_t columns = count("the number of horizontal angles");
    require_type_c();
    for (const char* what : {"the units", "the width", "the length", "the height"}) number(what);
    factor *= positive("the ballast factor");
    factor *= positive("the ballast-lamp factor");
    number("the watts");
    IesProfile profile;
    profile.vertical = angles(rows, "a vertical angle");
    check_vertical(profile.vertical);
    profile.horizontal = angles(columns, "a horizontal angle");
    check_horizontal(profile.horizontal);
    for (size_t i = 0; i < rows * columns; ++i) profile.candela.push_back(candela(factor));
    return profile;
  }

 private:
  /// Goes to the line after that with TILT.
  void skip_keywords() {
    for (; !text_.at_end(); text_.next_line()) {
      const std::string line = text_.rest_of_line();
      if (line.substr(0, 5) != "TILT=") continue;
      if (line != "TILT=NONE")
        text_.fail(quote(line) +
                   " is not supported; write TILT=NONE, for a lamp that is not tilted");
      return text_.next_line();
    }
    text_.fail("has no line TILT=NONE: it is no IES file (LM-63)");
  }

  double number(const char* what) {
    text_.skip_space();
    const double x = text_.real(what);
    if (!std::isfinite(x)) text_.fail(fmt::format("{} is not finite", what));
    return x;
  }
  double positive(const char* what) {
    const double x = number(what);
    if (!(x > 0)) text_.fail(fmt::format("{} is {:g}, but should be above 0", what, x));
    return x;
  }
  size_t count(const char* what) {
    const double n = number(what);
    if (!(n >= 1 && n <= most_angles && n == std::floor(n)))
      text_.fail(
          fmt::format("{} is {:g}, but should be an integer from 1 to {}", what, n, most_angles));
    return static_cast<size_t>(n);
  }
  double candela(double factor) {
    const double x = number("a candela value") * factor;
    if (!(x >= 0 && x <= most_candela))
      text_.fail(
          fmt::format("a candela value is {:g}, but should be from 0 to {:g}", x, most_candela));
    return x;
  }

  void require_type_c() {
    const double type = number("the photometric type");
    if (type != 1)
      text_.fail(
          fmt::format("the photometric type is {:g}; only 1 is supported, which is type C", type));
  }

  std::vector<double> angles(size_t n, const char* what) {
    std::vector<double> all;
    for (size_t i = 0; i < n; ++i) {
      const double x = number(what);
      if (i > 0 && !(x > all.back()))
        text_.fail(
            fmt::format("{} is {:g} after {:g}, but angles should ascend", what, x, all.back()));
      all.push_back(x);
    }
    return all;
  }

  void check_vertical(const std::vector<double>& all) const {
    const double first = all.front(), last = all.back();
    const bool fits = (first == 0 && (last == 90 || last == 180)) || (first == 90 && last == 180);
    if (!fits)
      text_.fail(
          fmt::format("vertical angles run from {:g} to {:g}, but should run from 0 to 90, "
                      "0 to 180 or 90 to 180",
                      first, last));
  }
  void check_horizontal(const std::vector<double>& all) const {
    const double last = all.back();
    if (all.front() != 0 || (last != 0 && last != 90 && last != 180 && last != 360))
      text_.fail(
          fmt::format("horizontal angles run from {:g} to {:g}, but should be 0 alone or "
                      "run from 0 to 90, 180 or 360",
                      all.front(), last));
  }

  TextScanner text_;
};

/// Adds the mirror images of all columns but those on the plane at `angle` degrees.
void mirror(IesProfile& profile, double angle) {
  const size_t rows = profile.vertical.size();
  for (size_t i = profile.horizontal.size(); i-- > 0;) {
    if (profile.horizontal[i] == angle) continue;
    profile.horizontal.push_back(2 * angle - profile.horizontal[i]);
    for (size_t row = 0; row < rows; ++row)
      profile.candela.push_back(profile.candela[i * rows + row]);
  }
}

}  // namespace

IesProfile parse_ies(std::string_view bytes, const std::string& name) {
  IesProfile profile = IesReader(bytes, name).read();
  if (profile.horizontal.back() == 0) mirror(profile, 180);
  if (profile.horizontal.back() == 90) mirror(profile, 90);
  if (profile.horizontal.back() == 180) mirror(profile, 180);
  return profile;
}

}  // namespace mlt
