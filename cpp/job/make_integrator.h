// Choice of the integrator and its settings: the scene's own one or another one by name, with
// single parameters replaced.
#pragma once

#include "io/load.h"
#include "job/json.h"
#include "rendering/integrator.h"

#include <string>
#include <utility>
#include <vector>

namespace mlt {

/// Pairs (name, value) as the user typed them, such as `-p max_depth=8`.
using Assignments = std::vector<std::pair<std::string, std::string>>;

struct MadeIntegrator {
  IntegratorPtr integrator;
  Node node;      ///< The node from which it was made.
  Json settings;  ///< Its type and every parameter, given or default.
  std::vector<std::string> warnings;
  std::string aovs;              ///< Layers that an integrator `aov` asks for.
  bool hide_emitters = false;    ///< Whether lights are left out that the camera sees directly.
  bool extra_mutations = false;  ///< Whether it has mutations that the node does not describe.
};

/// The integrator called `name`; with "" the scene's own, and `mlt` if it has none. One that
/// replaces the scene's own inherits the parameters that change the image that is estimated
/// (max_depth, hide_emitters, strict_normals), but no others. Throws UsageError for an assignment
/// that the integrator does not know.
Node choose_integrator(const LoadedScene& loaded, const std::string& name,
                       const Assignments& assignments, const Registry& registry);

/// Why the scene's own integrator cannot render, or "".
std::string integrator_problem(const LoadedScene& loaded, const Registry& registry);

MadeIntegrator make_integrator(const Node& node, const Registry& registry);
/// Makes it again with layers of light: the parameters light_groups and light_layers. Throws
/// UsageError if it cannot keep them.
MadeIntegrator with_light_layers(const MadeIntegrator& made, const LightLayerSettings& layers,
                                 const Registry& registry);
/// The node that makes it again. Throws UsageError if it has mutations that no node can describe.
const Node& node_of(const MadeIntegrator& made);
/// Adds mutations; the settings list their names and weights as "extra_mutations".
MadeIntegrator with_mutations(MadeIntegrator made, const std::vector<ExtraMutation>& extra);

}  // namespace mlt
