// What is wrong in a scene, collected, and told in one error.
#pragma once

#include "base/error.h"

#include <string>
#include <vector>

namespace mlt {

class Mistakes {
 public:
  /// Whether `check` finds nothing wrong; a SceneError of it is kept, each once.
  template <class Check>
  bool note(const Check& check, const Location& where) {
    try {
      check();
      return true;
    } catch (const SceneError& error) {
      add(error.what(), where);
      return false;
    }
  }
  /// Throws SceneError, in one line, if there are any: the first twenty, and how many more.
  void report() const;

 private:
  void add(std::string what, const Location& where);

  struct Found {
    Location where;
    std::string what;
  };
  std::vector<Found> found_;
};

}  // namespace mlt
