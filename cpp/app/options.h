// What a person can ask of mlt-render.
#pragma once

#include "io/load.h"
#include "render/job.h"
#include "render/make_integrator.h"

#include <string>
#include <vector>

namespace mlt {

struct Options {
  std::string scene;
  std::vector<std::string> outputs;  ///< Image files, by extension.
  std::string stats;                 ///< A JSON file, or "".
  std::string integrator;            ///< "": the scene's own.
  Assignments parameters;
  LoadOptions load;
  RenderSettings render;
  double exposure = 0;
  bool quiet = false;
};

/// "name=value" in two. Throws UsageError.
std::pair<std::string, std::string> parse_assignment(const std::string& flag,
                                                     const std::string& text);
/// "640x360". Throws UsageError.
Vec2i parse_size(const std::string& text);

}  // namespace mlt
