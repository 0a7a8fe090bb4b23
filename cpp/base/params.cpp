#include "base/params.h"

#include "base/bytes.h"
#include "base/magnitude.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace mlt {
namespace {

template <class T>
bool is(const Value& value) {
  return std::holds_alternative<T>(value);
}

bool is_number(const Value& value) { return is<int64_t>(value) || is<double>(value); }

bool is_color(const Value& value) {
  return is_number(value) || is<Triple>(value) || is<WavelengthTable>(value);
}

bool is_finite(const Value& value) {
  if (const double* x = std::get_if<double>(&value)) return std::isfinite(*x);
  const auto all_finite = [](const auto& numbers) {
    return std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); });
  };
  if (const Triple* t = std::get_if<Triple>(&value)) return all_finite(*t);
  if (const Matrix* m = std::get_if<Matrix>(&value)) return all_finite(*m);
  if (const WavelengthTable* s = std::get_if<WavelengthTable>(&value))
    return std::all_of(s->begin(), s->end(), [](const auto& sample) {
      return std::isfinite(sample.first) && std::isfinite(sample.second);
    });
  if (const Animation* a = std::get_if<Animation>(&value))
    return std::all_of(a->begin(), a->end(), [&](const Keyframe& key) {
      return std::isfinite(key.time) && all_finite(key.transform);
    });
  return true;
}

/// A coordinate or an entry of a transform that is too large for rays, if there is one.
std::optional<double> excess(const Value& value, ParamType type) {
  const auto first = [](const auto& numbers) -> std::optional<double> {
    const auto found = std::find_if(numbers.begin(), numbers.end(), too_large);
    return found == numbers.end() ? std::nullopt : std::optional(*found);
  };
  if (type == ParamType::point) return first(std::get<Triple>(value));
  if (const Matrix* m = std::get_if<Matrix>(&value)) return first(*m);
  if (const Animation* a = std::get_if<Animation>(&value))
    for (const Keyframe& key : *a)
      if (const auto found = first(key.transform)) return found;
  return std::nullopt;
}

bool fits(const Value& value, ParamType type) {
  switch (type) {
    case ParamType::boolean: return is<bool>(value);
    case ParamType::integer: return is<int64_t>(value);
    case ParamType::real: return is_number(value);
    case ParamType::text: return is<std::string>(value);
    case ParamType::point: return is<Triple>(value);
    case ParamType::transform: return is<Matrix>(value);
    case ParamType::motion: return is<Matrix>(value) || is<Animation>(value);
    case ParamType::reflectance:  // an object may be a spectrum
    case ParamType::radiance:
    case ParamType::lamp:
    case ParamType::texture:
    case ParamType::emission:
    case ParamType::volume: return is_color(value) || is<ObjectPtr>(value);
    case ParamType::buffer: return is<Buffer>(value);
    case ParamType::ior:
      return is_number(value) || is<std::string>(value) || is<WavelengthTable>(value);
    case ParamType::object: return is<ObjectPtr>(value);
  }
  return false;
}

std::string kind_of(const Value& value) {
  static const char* names[] = {"nothing",      "a boolean", "an integer", "a float",
                                "a string",     "a triple",  "a matrix",   "a spectrum",
                                "an animation", "an object", "an array"};
  return names[value.index()];
}

std::string with_article(const std::string& noun) {
  const bool vowel = std::string("aeiou").find(noun[0]) != std::string::npos;
  return (vowel ? "an " : "a ") + noun;
}

}  // namespace

Params::Params(const Schema& schema, Location where, std::string id)
    : schema_(&schema), where_(std::move(where)), id_(std::move(id)) {}

void Params::set(const std::string& given_name, Value value, const Location& where) {
  const std::string name = snake_case(given_name);
  const Parameter* parameter = schema_->find(name);
  if (!parameter) {
    const auto& ignored = schema_->ignored;
    if (std::find(ignored.begin(), ignored.end(), name) == ignored.end())
      throw SceneError(at(where, "unknown parameter '{}' for {}{}", given_name, title(),
                          suggestion(name, schema_->parameter_names())));
    warnings_.push_back(at(where, "{}: '{}' has no effect here", title(), name));
    return;
  }
  const auto refuse = [&](const std::string& why) {
    throw SceneError(at(where, "{}: '{}' {}", title(), name, why));
  };
  if (!fits(value, parameter->type))
    refuse("is " + kind_of(value) + ", but should be " + with_article(to_string(parameter->type)));
  if (!is_finite(value)) refuse("must be finite");
  if (const auto number = excess(value, parameter->type))
    refuse(fmt::format("has the number {:g}, but should have none beyond {:g}", *number,
                       largest_magnitude));
  const auto& choices = parameter->choices;
  if (const std::string* text = std::get_if<std::string>(&value))
    if (!choices.empty() && std::find(choices.begin(), choices.end(), *text) == choices.end())
      refuse("cannot be '" + *text + "'" + suggestion(*text, choices));
  if (!given_.emplace(name, Given{std::move(value), where}).second) refuse("is given twice");
}

void Params::add(const std::string& family, ObjectPtr object, const Location& where) {
  nested_.push_back({family, std::move(object), where});
}

void Params::replace(const std::string& name, Value value) {
  given_.at(name).value = std::move(value);
}

bool Params::has(const std::string& name) const {
  if (given_.count(name)) return true;
  return std::any_of(nested_.begin(), nested_.end(),
                     [&](const Nested& nested) { return nested.family == name; });
}

const Value& Params::read(const std::string& name) {
  const auto it = given_.find(name);
  if (it != given_.end()) {
    it->second.read = true;
    return it->second.value;
  }
  const Parameter* parameter = schema_->find(name);
  if (!parameter)
    throw Error("plug-in '" + schema_->name + "' reads '" + name + "', which its schema lacks");
  if (is<std::monostate>(parameter->default_value)) fail("needs '" + name + "': " + parameter->doc);
  return parameter->default_value;
}

bool Params::boolean(const std::string& name) { return std::get<bool>(read(name)); }
int64_t Params::integer(const std::string& name) { return std::get<int64_t>(read(name)); }
std::string Params::text(const std::string& name) { return std::get<std::string>(read(name)); }
Buffer Params::buffer(const std::string& name) { return std::get<Buffer>(read(name)); }
Triple Params::triple(const std::string& name) { return std::get<Triple>(read(name)); }
Matrix Params::matrix(const std::string& name) { return std::get<Matrix>(read(name)); }
const Value& Params::value(const std::string& name) { return read(name); }

double Params::real(const std::string& name) {
  const Value& value = read(name);
  if (const int64_t* integer = std::get_if<int64_t>(&value)) return static_cast<double>(*integer);
  return std::get<double>(value);
}

double Params::real_in(const std::string& name, double low, double high) {
  const double x = real(name);
  if (!(x >= low && x <= high))
    fail(name, fmt::format("is {:f}, but must lie between {:f} and {:f}", x, low, high));
  return x;
}

int64_t Params::integer_in(const std::string& name, int64_t low, int64_t high) {
  const int64_t x = integer(name);
  if (x < low || x > high)
    fail(name, fmt::format("is {}, but must lie between {} and {}", x, low, high));
  return x;
}

ObjectPtr Params::find_object(const std::string& name) {
  const auto it = given_.find(name);
  if (it != given_.end() && is<ObjectPtr>(it->second.value)) {
    it->second.read = true;
    return std::get<ObjectPtr>(it->second.value);
  }
  for (Nested& nested : nested_)
    if (nested.family == name) {
      nested.read = true;
      return nested.object;
    }
  return nullptr;
}

namespace {

struct KeyWriter {
  ByteWriter& bytes;

  void operator()(std::monostate) const {}
  void operator()(const Buffer& buffer) const {
    bytes.write(buffer.hash());
    bytes.write<uint64_t>(buffer.bytes().size());
  }
  void operator()(const ObjectPtr& object) const { bytes.write<const Object*>(object.get()); }
  template <class T>
  void operator()(const T& value) const {
    bytes.write(value);
  }
};

}  // namespace

std::string Params::key(const std::vector<std::string>& aside) const {
  ByteWriter bytes;
  bytes.write(title());
  bytes.write(id_);
  bytes.write(describe(where_));
  for (const auto& [name, given] : given_) {
    bytes.write(name);
    bytes.write<uint64_t>(given.value.index());
    std::visit(KeyWriter{bytes}, given.value);
  }
  for (const Nested& nested : nested_) {
    if (std::count(aside.begin(), aside.end(), nested.family)) continue;
    bytes.write(nested.family);
    bytes.write<const Object*>(nested.object.get());
  }
  return bytes.take();
}

std::vector<ObjectPtr> Params::nested() const {
  std::vector<ObjectPtr> all;
  for (const auto& [name, given] : given_)
    if (const auto* object = std::get_if<ObjectPtr>(&given.value)) all.push_back(*object);
  for (const Nested& nested : nested_) all.push_back(nested.object);
  return all;
}

std::string Params::title() const { return schema_->family + " '" + schema_->name + "'"; }

void Params::fail(const std::string& name, const std::string& message) const {
  const auto it = given_.find(name);
  const Location& place = it != given_.end() ? it->second.where : where_;
  throw SceneError(at(place, "{}: '{}' {}", title(), name, message));
}

void Params::fail(const std::string& message) const {
  throw SceneError(at(where_, title() + " " + message));
}

void Params::warn(const std::string& message) {
  warnings_.push_back(at(where_, title() + ": " + message));
}

void Params::expect_all_read() const {
  for (const auto& [name, given] : given_)
    if (!given.read) fail(name, "has no effect with the other parameters given");
  for (const Nested& nested : nested_)
    if (!nested.read)
      throw SceneError(at(nested.where, "{} does not take a nested {}", title(), nested.family));
}

}  // namespace mlt
