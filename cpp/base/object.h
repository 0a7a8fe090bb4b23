// The base of everything a scene description can name.
#pragma once

#include "base/error.h"

#include <memory>
#include <string>

namespace mlt {

class Object {
 public:
  virtual ~Object() = default;

  /// A copy of this object for another scene; nullptr if it has to be made anew.
  virtual std::shared_ptr<Object> copy() const { return nullptr; }

  std::string type;  ///< Name of the plug-in that made it, or "".
  std::string id;    ///< The scene's name for it, or "".
  Location where;    ///< Where the scene describes it.
};

using ObjectPtr = std::shared_ptr<Object>;

}  // namespace mlt
