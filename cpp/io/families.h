// The families of plug-ins in scenes, and those of Mitsuba that are refused.
#pragma once

#include "base/error.h"

#include <string>
#include <vector>

namespace mlt {

/// "bsdf", "emitter", "film", "integrator", "medium", "phase", "rfilter", "sampler", "sensor",
/// "shape", "texture", "volume".
const std::vector<std::string>& plugin_families();
bool is_plugin_family(const std::string& tag);
/// Elements at the top of a scene.
const std::vector<std::string>& scene_tags();
/// Whether the string `filename` of a family is a file to read. (A film's is one to write.)
bool reads_a_file(const std::string& family);

/// Whether refuse_element() refuses this element.
bool is_refused_element(const std::string& tag);
/// Throws SceneError, in one line with the reason, for an element that Mitsuba has and this
/// renderer refuses (cameras of old versions, spectra as plug-ins, ...). `type` may be "".
void refuse_element(const std::string& tag, const std::string& type, const Location& where);

}  // namespace mlt
