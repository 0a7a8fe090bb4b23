// Indices of refraction that depend on the wavelength: dispersion.
#pragma once

#include "base/schema.h"
#include "math/curve.h"

#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace mlt {

/// The Fraunhofer lines, in nm, at which catalogues give indices: n_d, n_F and n_C; and the middle
/// of the sodium doublet D.
inline constexpr double line_d = 587.56, line_f = 486.13, line_c = 656.27, sodium_line = 589.3;

/// A term B lambda^2 / (lambda^2 - C) of Sellmeier's formula, lambda in micrometres.
struct SellmeierTerm {
  double b, c;
};

/// n(lambda), finite and positive in the visible range: the factories throw UsageError otherwise.
class RefractiveIndex {
 public:
  static RefractiveIndex constant(double n);
  /// n = a + b / lambda^2, b in nm^2.
  static RefractiveIndex cauchy(double a, double b);
  /// n^2 = 1 + the sum of the terms. One with c = 0 is a constant.
  static RefractiveIndex sellmeier(std::vector<SellmeierTerm> terms);
  /// Cauchy's formula with the index n_d and Abbe's number V_d = (n_d - 1) / (n_F - n_C), which is
  /// infinite without dispersion. KHR_materials_dispersion has 20 / V_d.
  static RefractiveIndex abbe(double n_d, double v_d);
  /// Linear between pairs of (nm, n), and constant before the first and after the last.
  static RefractiveIndex table(const WavelengthTable& pairs);

  double at(double nm) const {
    return std::visit([nm](const auto& form) { return form.at(nm); }, form_);
  }
  bool disperses() const { return disperses_; }
  /// The index at the sodium line, which stands for all in RGB.
  double sodium() const { return at(sodium_line); }

 private:
  struct Cauchy {
    double a, b;
    double at(double nm) const { return a + b / (nm * nm); }
  };
  struct Sellmeier {
    std::shared_ptr<const std::vector<SellmeierTerm>> terms;  // shared, so that copies are cheap
    double at(double nm) const;
  };
  using Form = std::variant<Cauchy, Sellmeier, Curve>;

  /// `origin` says in messages what gave the index.
  RefractiveIndex(Form form, bool disperses, const std::string& origin);

  Form form_;
  bool disperses_;
};

}  // namespace mlt
