// The Mitsuba 3 dict: every plug-in is a dict with its name under "type"; colours, spectra and
// references are dicts with types of their own ("rgb", "srgb", "spectrum", "ref");
// transforms are 4 x 4 matrices, or animations of them; a colour may be an animation, too. A nested
// plug-in's key is the parameter it is given for, or, in a scene, its id.
#include "scene_dict.h"

#include "text.h"

#include "base/text.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <filesystem>

namespace mlt::python {
namespace {

std::string kind_of(const py::handle& object) {
  return "of type " + std::string(py::str(py::type::of(object).attr("__name__")));
}

[[noreturn]] void refuse(const Location& where, const std::string& key,
                         const std::string& message) {
  throw SceneError(at(where, "'" + key + "' " + message));
}

/// A str as bytes; file names need not be UTF-8.
std::string str_of(const py::handle& text, const std::string& key, const Location& where) {
  try {
    return bytes_of(text);
  } catch (const UsageError& error) {
    refuse(where, key, std::string("cannot be read: ") + error.what());
  }
}

Value from_array(const py::object& object, const std::string& key, const Location& where) {
  const auto array = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(object);
  if (!array) {
    PyErr_Clear();
    refuse(where, key, "is " + kind_of(object) + ", which is neither numbers nor a plug-in");
  }
  const double* data = array.data();
  if (array.ndim() == 1 && array.size() == 3) return Triple{data[0], data[1], data[2]};
  if (array.ndim() == 2 && array.shape(0) == 4 && array.shape(1) == 4) {
    Matrix matrix;
    std::copy_n(data, 16, matrix.begin());
    return matrix;
  }
  refuse(where, key, "is an array that is neither 3 numbers nor a 4 x 4 matrix");
}

Value from_number(const py::object& number, const std::string& key, const Location& where) {
  try {
    if (PyLong_Check(number.ptr())) return number.cast<int64_t>();
    return number.cast<double>();
  } catch (const py::cast_error&) {
    refuse(where, key, "is an integer that does not fit into 64 bits");
  }
}

Value from_scalar_or_array(py::object object, const std::string& key, const Location& where) {
  if (py::hasattr(object, "__fspath__")) object = object.attr("__fspath__")();
  if (py::hasattr(object, "ndim") && py::object(object.attr("ndim")).equal(py::int_(0)))
    object = object.attr("item")();  // a numpy scalar
  if (object.is_none()) refuse(where, key, "is None; leave it out to get its default");
  if (py::isinstance<py::str>(object)) return str_of(object, key, where);
  if (py::isinstance<py::bytes>(object)) return Buffer(object.cast<std::string>());
  if (PyBool_Check(object.ptr())) return object.cast<bool>();
  if (PyLong_Check(object.ptr()) || PyFloat_Check(object.ptr()))
    return from_number(object, key, where);
  if (py::hasattr(object, "matrix")) object = object.attr("matrix");  // transforms, Mitsuba's too
  return from_array(object, key, where);
}

std::string text_of(const py::dict& dict, const char* key, const Location& where) {
  if (!dict.contains(key)) throw SceneError(at(where, std::string("needs a '") + key + "'"));
  const py::object value = dict[key];
  if (!py::isinstance<py::str>(value))
    refuse(where, key, "is " + kind_of(value) + ", but should be a string");
  return str_of(value, key, where);
}

/// {"type": "rgb", "value": [...]} and its like: a value that is written as a dict. The `color` of
/// Mitsuba's `srgb` is as linear as an rgb; only its name says otherwise.
Value from_color(const py::dict& dict, const std::string& type, const std::string& key,
                 const Location& where) {
  const char* held = type == "srgb" ? "color" : "value";
  for (const auto& item : dict) {
    const std::string name = str_of(py::str(item.first), key, where);
    const bool is_permission = type == "srgb" && name == "unbounded";  // it is, in any case
    if (name != "type" && name != held && !is_permission)
      refuse(where, key, "has an unknown '" + name + "'; valid are: type, " + held);
  }
  if (!dict.contains(held)) refuse(where, key, std::string("needs a '") + held + "'");
  const py::object value = dict[held];
  if (type == "spectrum" && (py::isinstance<py::list>(value) || py::isinstance<py::tuple>(value))) {
    try {
      return value.cast<WavelengthTable>();
    } catch (const py::cast_error&) {
      refuse(where, key, "should be a number or a list of (wavelength, value) pairs");
    }
  }
  Value given = from_scalar_or_array(value, key, where);
  if (type != "spectrum") return given;
  if (const auto* real = std::get_if<double>(&given)) return constant_spectrum(*real);
  if (const auto* whole = std::get_if<int64_t>(&given))
    return constant_spectrum(static_cast<double>(*whole));
  return given;
}

/// The keys of {"type": "animation", "0": value, "1": value} in the order of time, which is text or
/// a number.
std::vector<std::pair<double, py::object>> keys_of(const py::dict& dict, const std::string& key,
                                                   const Location& where) {
  std::vector<std::pair<double, py::object>> keys;
  for (const auto& [time, value] : dict) {
    const std::string text = str_of(py::str(time), key, where);
    if (text == "type") continue;
    const auto number = parse_real(text);
    if (!number) refuse(where, key, "has the key '" + text + "', which is not a time");
    keys.emplace_back(*number, py::reinterpret_borrow<py::object>(value));
  }
  std::stable_sort(keys.begin(), keys.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  return keys;
}

/// Whether the keys of an animation are transforms, as the first one tells.
bool moves(const py::dict& dict, const std::string& key, const Location& where) {
  const auto keys = keys_of(dict, key, where);
  if (keys.empty()) return true;
  const py::object& first = keys.front().second;
  if (py::isinstance<py::dict>(first) || py::hasattr(first, "to_dict")) return false;
  return std::holds_alternative<Matrix>(from_scalar_or_array(first, key, where));
}

Animation from_animation(const py::dict& dict, const std::string& key, const Location& where) {
  Animation animation;
  for (const auto& [time, value] : keys_of(dict, key, where)) {
    const Value given = from_scalar_or_array(value, key, where);
    const auto* matrix = std::get_if<Matrix>(&given);
    if (!matrix) refuse(where, key, "should have a 4 x 4 matrix at each time");
    animation.push_back({time, *matrix});
  }
  return animation;
}

/// The colours that are values. In a scene, where others refer to it, rgb is a plug-in.
bool is_color(const std::string& type) {
  return type == "rgb" || type == "srgb" || type == "spectrum";
}

/// Numbers that a spectrum has as text, which reads back as the same numbers.
bool is_list_of_text(const Node& node, const std::string& key) {
  return (node.type == "regular" || node.type == "irregular") &&
         (key == "values" || key == "wavelengths");
}

Value text_of_numbers(const py::object& list, const std::string& key, const Location& where) {
  if (py::isinstance<py::str>(list)) return str_of(list, key, where);
  const auto array = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(list);
  if (!array || array.ndim() != 1) {
    PyErr_Clear();
    refuse(where, key, "should be a list of numbers");
  }
  std::string text;
  for (py::ssize_t i = 0; i < array.size(); ++i) text += fmt::format("{} ", array.data()[i]);
  return text;
}

std::string family_of(const std::string& type, const std::string& key, const Location& where,
                      const Registry& registry) {
  const std::vector<std::string> found = registry.families_of(type);
  if (found.size() == 1) return found[0];
  const std::vector<std::string> families = registry.families();
  const auto& candidates = found.empty() ? families : found;
  if (key == "sampler" || std::count(candidates.begin(), candidates.end(), key)) return key;
  if (!found.empty()) return found[0];
  std::vector<std::string> all;
  for (const std::string& family : families)
    for (const std::string& name : registry.names(family)) all.push_back(name);
  const std::string near = closest(type, all);
  throw SceneError(at(where, "unknown type '" + type + "'" +
                                 (near.empty() ? "" : "; did you mean '" + near + "'?")));
}

class Converter {
 public:
  explicit Converter(const Registry& registry) : registry_(registry) {}

  Node convert(const py::dict& dict, const std::string& family, const std::string& path) {
    if (++depth_ > 64) throw SceneError(path.substr(0, 200) + "...: dicts are nested too deeply");
    Node node;
    node.family = family;
    node.where = {path, 0};
    node.type = text_of(dict, "type", node.where);
    if (dict.contains("id")) node.id = text_of(dict, "id", node.where);
    for (const auto& [key_object, value] : dict) {
      if (!py::isinstance<py::str>(key_object))
        throw SceneError(at(node.where, "a key is " + kind_of(key_object) + ", not a string"));
      const std::string key = str_of(key_object, "a key", node.where);
      if (key != "type" && key != "id") add(node, key, py::reinterpret_borrow<py::object>(value));
    }
    --depth_;
    return node;
  }

 private:
  void add(Node& node, const std::string& key, py::object value) {
    const std::string path = node.where.file + "['" + key + "']";
    if (py::hasattr(value, "to_dict")) value = value.attr("to_dict")();
    if (is_list_of_text(node, key)) {
      node.properties.push_back({key, text_of_numbers(value, key, node.where), node.where});
      return;
    }
    if (!py::isinstance<py::dict>(value)) {
      if (node.family == "scene") refuse(node.where, key, "should be a plug-in (a dict)");
      Value converted = from_scalar_or_array(value, key, node.where);
      if (std::string* text = std::get_if<std::string>(&converted); text && key == "filename")
        *text = std::filesystem::absolute(*text).lexically_normal().string();
      node.properties.push_back({key, std::move(converted), node.where});
      return;
    }
    const auto dict = py::reinterpret_borrow<py::dict>(value);
    const std::string type = text_of(dict, "type", {path, 0});
    if (is_color(type) && node.family != "scene") {
      node.properties.push_back({key, from_color(dict, type, key, node.where), node.where});
      return;
    }
    if (type == "animation" && !moves(dict, key, node.where)) {
      node.children.push_back(animated(dict, key, path));
      return;
    }
    if (type == "animation") {
      node.properties.push_back({key, from_animation(dict, key, node.where), node.where});
      return;
    }
    node.children.push_back(type == "ref" ? reference(dict, path) : nested(dict, type, key, path));
    Node& child = node.children.back();
    if (node.family != "scene")
      child.name = key;
    else if (child.id.empty())
      child.id = key;
  }

  /// A texture whose keys are these colours, numbers or textures.
  Node animated(const py::dict& dict, const std::string& name, const std::string& path) {
    Node animation{"texture", "animation", "", name, {path, 0}, {}, {}};
    for (const auto& [time, value] : keys_of(dict, name, animation.where)) {
      const Location where{path + fmt::format("['{:g}']", time), 0};
      animation.children.push_back({"texture", "key", "", "", where, {{"time", time, where}}, {}});
      add(animation.children.back(), "value", value);
    }
    return animation;
  }

  Node nested(const py::dict& dict, const std::string& type, const std::string& key,
              const std::string& path) {
    return convert(dict, family_of(type, key, {path, 0}, registry_), path);
  }

  static Node reference(const py::dict& dict, const std::string& path) {
    return {"ref", text_of(dict, "id", {path, 0}), "", "", {path, 0}, {}, {}};
  }

  const Registry& registry_;
  int depth_ = 0;
};

}  // namespace

Value to_value(const py::object& object, const std::string& parameter, const Location& where) {
  return from_scalar_or_array(object, parameter, where);
}

Node to_node(const py::dict& dict, const std::string& family, const std::string& path,
             const Registry& registry) {
  return Converter(registry).convert(dict, family, path);
}

}  // namespace mlt::python
