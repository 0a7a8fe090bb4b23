// Objects that are nested in a plug-in, whatever their names.
#pragma once

#include "base/params.h"

namespace mlt {

/// The one nested object of this family. Throws SceneError if there is none, or are several.
template <class T>
std::shared_ptr<T> only_nested(Params& params, const char* family) {
  const auto nested = params.objects<T>();
  if (nested.size() != 1)
    params.fail(fmt::format("needs one nested {}, but has {}", family, nested.size()));
  return nested.front();
}

}  // namespace mlt
