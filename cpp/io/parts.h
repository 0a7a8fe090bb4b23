// The objects that a scene was built of, by the parameters that each was made with: a scene that
// differs from it in few parameters is built of the same objects, and their files are not read
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
  std::vector<ObjectPtr> nested;      ///< Nested objects, whose addresses are in the key.
  std::vector<std::string> warnings;  ///< Warnings when it was made.
};

/// Parts by Params::key.
using Parts = std::unordered_multimap<std::string, Part>;

/// Returns each part once: equal parts may be several objects.
class PartSource {
 public:
  explicit PartSource(const Parts* parts) : parts_(parts) {}

  /// A part with this key, or nullptr if there is none left.
  const Part* take(const std::string& key);

 private:
  const Parts* parts_;
  std::unordered_set<const Part*> taken_;
};

/// The object for use in another scene: itself, a copy if it stores data of its scene, or nullptr
/// if it has to be made anew.
ObjectPtr for_scene(const ObjectPtr& object);

}  // namespace mlt
