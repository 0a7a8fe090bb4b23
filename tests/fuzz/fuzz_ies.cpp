#include "fuzz.h"

#include "scene/emitter/ies_file.h"
#include "scene/emitter/intensity_table.h"

/// Rays of a luminaire can be drawn, unless it is dark.
void mlt::fuzz::read(std::string_view bytes) {
  IesProfile profile = parse_ies(bytes, "input");
  for (double& angle : profile.vertical) angle *= degree;
  for (double& angle : profile.horizontal) angle *= degree;
  const IntensityTable table(profile.vertical, profile.horizontal, profile.candela);
  table.invert(table.sample({0.3, 0.6}));
  table.integral();
}
