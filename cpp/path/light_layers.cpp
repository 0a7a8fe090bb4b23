#include "path/light_layers.h"

#include "base/error.h"

#include <algorithm>
#include <cctype>
#include <iterator>

namespace mlt {
namespace {

/// Names that are those of other layers, and beginnings of such names.
constexpr const char *taken[] = {"alpha",   "chains",     "error", "error_block",
                                 "samples", "unfiltered", "noisy", "denoised_error"},
                     *taken_beginnings[] = {"light.", "exposure.", "error.",
                                            "raw.",   "weighted.", "spectrum."};

bool is_taken(const std::string& name) {
  return std::find(std::begin(taken), std::end(taken), name) != std::end(taken) ||
         std::any_of(std::begin(taken_beginnings), std::end(taken_beginnings),
                     [&](const char* beginning) { return name.rfind(beginning, 0) == 0; });
}

std::string name_of(const Emitter& emitter) {
  std::string id = emitter.id;
  if (id.empty() && emitter.shape()) id = emitter.shape()->id;
  if (id.empty()) id = "rest";
  std::replace_if(id.begin(), id.end(), [](unsigned char c) { return std::isspace(c); }, '_');
  return "light." + id;
}

}  // namespace

std::string LightLayerSettings::text() const {
  std::string all;
  for (const auto& [name, expression] : classes) {
    const std::string text = name + "=" + expression;
    if (text.find_first_of(" \t\n\r\v\f") != std::string::npos)
      throw UsageError("the layer '" + text + "' has a blank; write it without");
    all += (all.empty() ? "" : " ") + text;
  }
  return all;
}

std::string path_class(const Path& path) {
  std::string letters = "L";
  for (int i = 1; i < path.edges(); ++i)
    letters += path[i].delta() ? 'S' : path[i].at.in_medium() ? 'M' : 'D';
  return letters + 'E';
}

std::regex class_expression(const std::string& name, const std::string& expression) {
  if (name.empty() || is_taken(name))
    throw UsageError("a layer of paths cannot be called '" + name + "'; choose another name");
  try {
    return std::regex(expression);
  } catch (const std::regex_error&) {
    throw UsageError("layer '" + name + "': '" + expression +
                     "' is not a regular expression over the letters L, S, D, M and E, such as "
                     "LS+DE");
  }
}

void check_layers(LayerMask layers, int count) {
  if (uint64_t{layers} >> count != 0)
    throw RenderError("the saved state has layers that do not exist");
}

LightLayers::LightLayers(const Scene& scene, const LightLayerSettings& settings) {
  if (settings.groups && settings.exposures)
    throw UsageError("light_groups and exposure_layers exclude each other; choose one");
  if (settings.groups) add_groups(scene);
  if (settings.exposures) add_exposures(scene.camera().shutter());
  for (const auto& [name, expression] : settings.classes) {
    classes_.push_back(class_expression(name, expression));
    if (std::find(names_.begin(), names_.end(), name) != names_.end())
      throw UsageError("two layers of paths are called '" + name + "'");
    add(name);
  }
}

void LightLayers::add_groups(const Scene& scene) {
  for (const EmitterPtr& emitter : scene.emitters()) {
    const std::string name = name_of(*emitter);
    const auto known = std::find(names_.begin(), names_.end(), name);
    const auto layer = known - names_.begin();
    if (known == names_.end()) add(name);
    of_emitter_.push_back(LayerMask{1} << layer);
  }
  groups_ = count();
}

void LightLayers::add_exposures(const Shutter& shutter) {
  for (int i = 1; i <= shutter.exposures; ++i) add("exposure." + std::to_string(i));
  shutter_ = shutter;
  groups_ = count();
}

LayerMask LightLayers::group_of(const Path& path) const {
  if (shutter_) return LayerMask{1} << shutter_->exposure(path.time);
  return of_emitter_.empty() ? 0 : of_emitter_[path[0].emitter];
}

void LightLayers::add(const std::string& name) {
  if (names_.size() == most)
    throw UsageError("there would be more than " + std::to_string(most) +
                     " layers of light; give lamps the same id, leave out light_groups, or have "
                     "fewer exposures");
  names_.push_back(name);
}

LayerMask LightLayers::layers_of_class(const std::string& letters) const {
  LayerMask layers = 0;
  for (size_t i = 0; i < classes_.size(); ++i)
    if (std::regex_match(letters, classes_[i])) layers |= LayerMask{1} << (groups_ + i);
  return layers;
}

LayerMask LightLayers::Finder::of(const Path& path) {
  if (!layers_) return 0;
  const LayerMask group = layers_->group_of(path);
  if (layers_->classes_.empty()) return group;
  const auto [known, is_new] = known_.try_emplace(path_class(path), 0);
  if (is_new) known->second = layers_->layers_of_class(known->first);
  return group | known->second;
}

}  // namespace mlt
