// The nodes of a scene's tree that say how it is looked at: its sensors, films and integrator.
#pragma once

#include "io/load.h"

#include <functional>

namespace mlt {

/// The scene with the index of the sensor that is asked for.
Node asking_for(Node scene, int64_t sensor);
/// How many sensors a scene has.
size_t sensor_count(const Node& scene);
/// The sensor that is asked for, or the first one. Throws SceneError if there is none, UsageError
/// if there are not so many.
const Node& chosen_sensor(const Node& scene, std::vector<std::string>& warnings);

/// Calls change(film) for all films, and adds a film to sensors that have none.
void change_films(Node& node, const std::function<void(Node&)>& change);
/// Makes films spectral; those of a band if it is not empty.
void make_spectral(Node& tree, const std::string& band);

/// The integrator inside of those of Mitsuba that only add layers or statistics to another one, or
/// itself; `aovs` becomes the layers. Throws SceneError where there is none inside.
const Node& unwrapped(const Node& integrator, std::string& aovs,
                      std::vector<std::string>& warnings);
/// Finds the integrator of a scene, and the layers of those around it. Throws SceneError if there
/// are two.
void find_integrator(const Node& scene, LoadedScene& loaded);

}  // namespace mlt
