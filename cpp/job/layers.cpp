#include "job/layers.h"

#include "job/json.h"
#include "job/plugins.h"

#include <fmt/format.h>

#include <algorithm>

namespace mlt {
namespace {

constexpr std::string_view prefix = "cryptomatte/", suffix = "/name";

std::string hexadecimal(uint32_t id) { return fmt::format("{:08x}", id); }

/// The ids of all names, as JSON.
std::string manifest(const std::vector<std::string>& names) {
  Json ids;
  for (const std::string& name : names) ids.add(name, hexadecimal(cryptomatte_id(name)));
  return ids.text();
}

/// Whether the attribute tells the name of a Cryptomatte.
bool is_name(std::string_view attribute) {
  return attribute.size() > prefix.size() + suffix.size() &&
         attribute.substr(0, prefix.size()) == prefix &&
         attribute.substr(attribute.size() - suffix.size()) == suffix;
}

bool is_numbered(std::string_view layer, std::string_view name) {
  if (layer.size() <= name.size() || layer.substr(0, name.size()) != name) return false;
  return layer.find_first_not_of("0123456789", name.size()) == std::string_view::npos;
}

}  // namespace

void ask_for_layers(const std::string& list, const LoadedScene& loaded, RenderSettings& settings) {
  settings.aovs = parse_aovs(list);
  for (const Aov& aov : settings.aovs)
    if (is_cryptomatte(aov.kind)) settings.names = surface_names(loaded, plugins());
}

Metadata cryptomatte_metadata(const RenderSettings& settings) {
  Metadata all;
  for (const Aov& aov : settings.aovs) {
    if (!is_cryptomatte(aov.kind)) continue;
    const std::string key =
        std::string(prefix) + hexadecimal(cryptomatte_id(aov.name)).substr(0, 7);
    all.emplace_back(key + std::string(suffix), aov.name);
    all.emplace_back(key + "/hash", "MurmurHash3_32");
    all.emplace_back(key + "/conversion", "uint32_to_float32");
    all.emplace_back(key + "/manifest", manifest(cryptomatte_names(aov.kind, settings.names)));
  }
  return all;
}

bool has_ids(const std::string& layer, const Metadata& metadata) {
  return std::any_of(metadata.begin(), metadata.end(), [&](const auto& text) {
    return is_name(text.first) && is_numbered(layer, text.second);
  });
}

}  // namespace mlt
