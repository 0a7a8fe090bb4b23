// Every reconstruction filter, with its default parameters.
#pragma once

#include "image/filter.h"

#include <vector>

namespace mlt::test {

inline std::vector<Filter> default_filters() {
  return {box_filter(),      tent_filter(),       gaussian_filter(),
          mitchell_filter(), catmullrom_filter(), lanczos_filter()};
}

}  // namespace mlt::test
