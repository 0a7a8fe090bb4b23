#include "base/schema.h"

#include <cctype>

namespace mlt {

std::string to_string(ParamType type) {
  switch (type) {
    case ParamType::boolean: return "boolean";
    case ParamType::integer: return "integer";
    case ParamType::real: return "float";
    case ParamType::text: return "string";
    case ParamType::point: return "point or vector";
    case ParamType::transform: return "transform";
    case ParamType::motion: return "transform or animation";
    case ParamType::reflectance: return "reflectance (number, rgb or spectrum)";
    case ParamType::radiance: return "radiance (number, rgb or spectrum)";
    case ParamType::lamp: return "radiance (number, rgb or spectrum) or animation";
    case ParamType::texture: return "reflectance or texture";
    case ParamType::emission: return "radiance or texture";
    case ParamType::volume: return "radiance or volume";
    case ParamType::buffer: return "array";
    case ParamType::ior: return "number or material name";
    case ParamType::object: return "nested object";
  }
  return "";
}

Parameter choice_parameter(const std::string& name, const std::string& default_value,
                           const std::string& doc, const std::vector<std::string>& choices) {
  return {name, ParamType::text, default_value, doc, choices};
}

std::vector<Parameter> concat(std::initializer_list<std::vector<Parameter>> lists) {
  std::vector<Parameter> all;
  for (const auto& list : lists) all.insert(all.end(), list.begin(), list.end());
  return all;
}

const Parameter* Schema::find(const std::string& parameter) const {
  for (const Parameter& p : parameters)
    if (p.name == parameter) return &p;
  return nullptr;
}

std::vector<std::string> Schema::parameter_names() const {
  std::vector<std::string> names;
  for (const Parameter& p : parameters) names.push_back(p.name);
  return names;
}

std::string snake_case(const std::string& name) {
  std::string out;
  for (size_t i = 0; i < name.size(); ++i) {
    const bool upper = std::isupper(static_cast<unsigned char>(name[i]));
    const bool previous_lower = i > 0 && std::islower(static_cast<unsigned char>(name[i - 1]));
    if (upper && previous_lower) out += '_';
    out += static_cast<char>(std::tolower(static_cast<unsigned char>(name[i])));
  }
  return out;
}

}  // namespace mlt
