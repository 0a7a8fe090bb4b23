// The parameters given to one plug-in, checked against its schema. Every read is tracked, so a
// parameter that nothing reads is an error instead of a silently different picture.
#pragma once

#include "base/schema.h"

#include <map>
#include <set>
#include <string>
#include <vector>

namespace mlt {

class Params {
 public:
  Params(const Schema& schema, Location where, std::string id = "");

  /// Gives a parameter. Throws SceneError for an unknown name ("did you mean"), a wrong type, a
  /// value outside the choices, or a second value; a known but ignored name adds a warning.
  void set(const std::string& name, Value value, const Location& where);

  /// Replaces a value that has been given.
  void replace(const std::string& name, Value value);

  /// Adds an unnamed nested object of the given family ("bsdf", "emitter", "texture", ...).
  void add(const std::string& family, ObjectPtr object, const Location& where);

  bool has(const std::string& name) const;

  // Each returns the given value or the schema's default, and throws SceneError when there is
  // neither.
  bool boolean(const std::string& name);
  int64_t integer(const std::string& name);
  double real(const std::string& name);
  std::string text(const std::string& name);
  Buffer buffer(const std::string& name);
  Triple triple(const std::string& name);
  Matrix matrix(const std::string& name);  ///< The matrix, row by row.
  /// The raw value of a reflectance, radiance, texture or emission parameter.
  const Value& value(const std::string& name);

  /// A real that must lie in [low, high].
  double real_in(const std::string& name, double low, double high);
  /// An integer that must lie in [low, high].
  int64_t integer_in(const std::string& name, int64_t low, int64_t high);

  /// The named or (by family) unnamed nested object, or nullptr; throws SceneError if there is one,
  /// but not a T.
  template <class T>
  std::shared_ptr<T> object(const std::string& name) {
    const ObjectPtr given = find_object(name);
    auto found = std::dynamic_pointer_cast<T>(given);
    if (given && !found) fail(name, "cannot be a '" + given->type + "'");
    return found;
  }
  /// All nested objects of type T, in the order they were given; of one family, if it is named.
  template <class T>
  std::vector<std::shared_ptr<T>> objects(const std::string& family = "") {
    std::vector<std::shared_ptr<T>> found;
    for (Nested& nested : nested_) {
      if (!family.empty() && nested.family != family) continue;
      if (auto object = std::dynamic_pointer_cast<T>(nested.object)) {
        nested.read = true;
        found.push_back(object);
      }
    }
    return found;
  }

  /// The given values as bytes, which are equal for two Params if the objects made from them are
  /// equal. Nested objects are equal if they are the same object; those of the families `aside` do
  /// not count.
  std::string key(const std::vector<std::string>& aside) const;
  /// All nested objects, named or not.
  std::vector<ObjectPtr> nested() const;

  /// Throws SceneError about one parameter: "file:line: diffuse: 'name' <message>".
  [[noreturn]] void fail(const std::string& name, const std::string& message) const;
  /// Throws SceneError about the plug-in as a whole.
  [[noreturn]] void fail(const std::string& message) const;
  void warn(const std::string& message);

  /// Throws SceneError if something that was given has not been read.
  void expect_all_read() const;

  const Schema& schema() const { return *schema_; }
  const Location& where() const { return where_; }
  const std::string& id() const { return id_; }
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  struct Given {
    Value value;
    Location where;
    bool read = false;
  };
  struct Nested {
    std::string family;
    ObjectPtr object;
    Location where;
    bool read = false;
  };

  std::string title() const;  ///< "bsdf 'diffuse'"
  ObjectPtr find_object(const std::string& name);
  const Value& read(const std::string& name);

  const Schema* schema_;
  Location where_;
  std::string id_;
  std::map<std::string, Given> given_;
  std::vector<Nested> nested_;
  std::vector<std::string> warnings_;
};

}  // namespace mlt
