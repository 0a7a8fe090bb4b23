// Objects that are nested in a plug-in, whatever their names.
#pragma once

#include "base/params.h"

#include <array>

namespace mlt {

/// The one nested object of this family. Throws SceneError if there is none, or are several.
template <class T>
std::shared_ptr<T> only_nested(Params& params, const char* family) {
  const auto nested = params.objects<T>(family);
  if (nested.size() != 1)
    params.fail(fmt::format("needs one nested {}, but has {}", family, nested.size()));
  return nested.front();
}

/// The two nested objects of this family. Throws SceneError if there are more or fewer.
template <class T>
std::array<std::shared_ptr<T>, 2> nested_pair(Params& params, const char* family) {
  const auto nested = params.objects<T>(family);
  if (nested.size() != 2)
    params.fail(fmt::format("needs two nested {}s, but has {}", family, nested.size()));
  return {nested[0], nested[1]};
}

/// The nested object of this family, or nullptr. Throws SceneError if there are several.
template <class T>
std::shared_ptr<T> optional_nested(Params& params, const char* family) {
  const auto nested = params.objects<T>(family);
  if (nested.size() > 1)
    params.fail(
        fmt::format("has {} nested elements <{}>, but can have one", nested.size(), family));
  return nested.empty() ? nullptr : nested.front();
}

}  // namespace mlt
