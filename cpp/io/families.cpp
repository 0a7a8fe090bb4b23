#include "io/families.h"

#include "base/text.h"

#include <algorithm>
#include <map>

namespace mlt {

const std::vector<std::string>& plugin_families() {
  static const std::vector<std::string> families{"bsdf",   "emitter", "film",    "integrator",
                                                 "medium", "phase",   "rfilter", "sampler",
                                                 "sensor", "shape",   "texture", "volume"};
  return families;
}

bool is_plugin_family(const std::string& tag) {
  const auto& families = plugin_families();
  return std::find(families.begin(), families.end(), tag) != families.end();
}

namespace {

const std::map<std::string, std::string>& refused_elements() {
  static const std::map<std::string, std::string> reasons{
      {"subsurface", "subsurface scattering is not supported"},
      {"blackbody", "write <spectrum type=\"blackbody\"> with a temperature"},
      {"camera", "this is the syntax of Mitsuba before 0.4; write <sensor>"},
      {"luminaire", "this is the syntax of Mitsuba before 0.4; write <emitter>"}};
  return reasons;
}

}  // namespace

const std::vector<std::string>& scene_tags() {
  static const std::vector<std::string> tags = [] {
    std::vector<std::string> all = plugin_families();
    all.insert(all.end(), {"default", "include", "path", "alias", "ref", "transform", "animation"});
    return all;
  }();
  return tags;
}

bool reads_a_file(const std::string& family) {
  return family == "shape" || family == "texture" || family == "emitter" || family == "bsdf" ||
         family == "volume";
}

bool is_refused_element(const std::string& tag) { return refused_elements().count(tag) > 0; }

void refuse_element(const std::string& tag, const std::string& type, const Location& where) {
  const auto reason = refused_elements().find(tag);
  if (reason == refused_elements().end()) return;
  const std::string title = type.empty() ? "<" + tag + ">" : tag + " " + quote(type);
  throw SceneError(at(where, "{} is not supported: {}", title, reason->second));
}

}  // namespace mlt
