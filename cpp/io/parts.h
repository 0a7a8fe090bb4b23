// The objects that a scene was built of, by the parameters that each was made with: a scene that
// differs from it in few parameters is built of the same objects, and what they read is not read
// again.
#pragma once

#include "base/params.h"

#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace mlt {

struct Part {
  ObjectPtr object;
  std::vector<ObjectPtr> nested;      ///< Which `key` tells apart by their addresses.
  std::vector<std::string> warnings;  ///< Of the making.
};

/// By Params::key.
using Parts = std::unordered_multimap<std::string, Part>;

/// Hands out parts, each once: equal ones may be several objects.
class PartSource {
 public:
  explicit PartSource(const Parts* parts) : parts_(parts) {}

  /// nullptr if there is none left with this key.
  const Part* take(const std::string& key);

 private:
  const Parts* parts_;
  std::unordered_set<const Part*> taken_;
};

/// What stands for the object in another scene, or in the first one: itself, a copy if the scene
/// tells it something, or nullptr if it has to be made anew.
ObjectPtr for_scene(const ObjectPtr& object);

}  // namespace mlt
