// Photometric files of luminaires in the format of the Illuminating Engineering Society: LM-63 of
// 1986 to 2002, of photometric type C and without a tilted lamp.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace mlt {

/// The intensities of a luminaire, all around it.
struct IesProfile {
  std::vector<double> vertical;    ///< Degrees from straight down, ascending.
  std::vector<double> horizontal;  ///< Degrees from 0 to 360, ascending.
  std::vector<double> candela;     ///< All of the first horizontal angle, then of the next one.
};

/// `name` is that of the file, for errors. Throws SceneError.
IesProfile parse_ies(std::string_view bytes, const std::string& name);

}  // namespace mlt
