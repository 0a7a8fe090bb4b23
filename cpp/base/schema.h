// The parameters of plug-ins: names, types, defaults and documentation.
// The loader, the Python classes, the docs and the error messages all read this one description.
#pragma once

#include "base/buffer.h"
#include "base/object.h"

#include <array>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace mlt {

/// A point, vector or RGB triple.
using Triple = std::array<double, 3>;
/// A 4 x 4 matrix, row by row as scenes write it.
using Matrix = std::array<double, 16>;
/// Samples (wavelength in nm, value) of a spectrum. A single one stands for all wavelengths.
using WavelengthTable = std::vector<std::pair<double, double>>;
inline WavelengthTable constant_spectrum(double value) { return {{550, value}}; }
/// A transform at one time; below, several of them in the order of time.
struct Keyframe {
  double time;
  Matrix transform;

  bool operator==(const Keyframe& other) const {
    return time == other.time && transform == other.transform;
  }
};
using Animation = std::vector<Keyframe>;

using Value = std::variant<std::monostate, bool, int64_t, double, std::string, Triple, Matrix,
                           WavelengthTable, Animation, ObjectPtr, Buffer>;

enum class ParamType {
  boolean,
  integer,
  real,
  text,
  point,        ///< Triple: a position or direction.
  transform,    ///< Matrix.
  motion,       ///< Matrix, or Animation.
  reflectance,  ///< A number, RGB or spectrum in [0, 1].
  radiance,     ///< A number, RGB or spectrum, unbounded.
  lamp,         ///< A radiance, or colours at times.
  texture,      ///< A reflectance, or a Texture.
  emission,     ///< A radiance, or a Texture.
  volume,       ///< A radiance, or a Volume.
  buffer,       ///< The bytes of an array.
  ior,          ///< An index of refraction: a number, or the name of a material.
  object  ///< Another plug-in, of the family that the parameter is named after or its doc names.
};

std::string to_string(ParamType type);

/// The default value of parameters without a default.
constexpr std::monostate no_default;

struct Parameter {
  std::string name;  ///< snake_case; the older camelCase is accepted everywhere.
  ParamType type;
  Value default_value;  ///< monostate: no default (required, or optional where the doc says so).
  std::string doc;
  std::vector<std::string> choices = {};  ///< For text: the valid values, if they are few.
};

/// A text parameter with few valid values.
Parameter choice_parameter(const std::string& name, const std::string& default_value,
                           const std::string& doc, const std::vector<std::string>& choices);
/// The parameters of several lists, one list after the other.
std::vector<Parameter> concat(std::initializer_list<std::vector<Parameter>> lists);

struct Schema {
  std::string family;  ///< "bsdf", "emitter", "sensor", "shape", "texture", "integrator", ...
  std::string name;
  std::string doc;
  std::vector<Parameter> parameters;
  std::vector<std::string> ignored = {};  ///< Known and without effect here: one warning, no error.
  bool conserves_energy = true;           ///< BSDFs: whether the white-furnace albedo is <= 1.
  bool reciprocal = true;                 ///< BSDFs: whether f(a, b) = f(b, a).
  bool unnamed_texture = false;           ///< Whether nested textures need no name.

  const Parameter* find(const std::string& parameter) const;
  std::vector<std::string> parameter_names() const;
};

/// Converts "toWorld" to "to_world", "intIOR" to "int_ior"; a snake_case name is unchanged.
std::string snake_case(const std::string& name);

}  // namespace mlt
