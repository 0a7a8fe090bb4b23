#include "app/options.h"

namespace mlt {
namespace {

template <class T>
std::vector<T> all(const FlagValues& given, const char* flag) {
  std::vector<T> values;
  if (const auto found = given.find(flag); found != given.end())
    for (const FlagValue& value : found->second) values.push_back(std::get<T>(value));
  return values;
}

/// Sets the target to the value of a flag, if it was given.
template <class T, class Target>
void take(const FlagValues& given, const char* flag, Target& target) {
  for (const T& value : all<T>(given, flag)) target = static_cast<Target>(value);
}

std::map<std::string, std::vector<std::string>> files_of(const FlagValues& given) {
  std::map<std::string, std::vector<std::string>> files;
  for (const Flag& flag : render_flags())
    if (flag.is(Flag::file)) files[flag.name] = all<std::string>(given, flag.name);
  return files;
}

}  // namespace

Options read_options(const FlagValues& given) {
  Options options;
  const auto text = [&](const char* flag, std::string& target) {
    take<std::string>(given, flag, target);
  };
  text("scene", options.scene);
  options.outputs = all<std::string>(given, "output");
  text("stats", options.stats);
  text("integrator", options.integrator);
  options.parameters = all<Assignments::value_type>(given, "parameters");
  for (const auto& [name, value] : all<Assignments::value_type>(given, "defines"))
    options.load.defines[name] = value;
  for (const auto& [width, height] : all<std::pair<int, int>>(given, "size"))
    options.load.size = Vec2i(width, height);
  for (const uint64_t sensor : all<uint64_t>(given, "sensor"))
    options.load.sensor = static_cast<int64_t>(sensor);
  text("filter", options.load.filter);
  options.load.spectral = given.count("spectral") > 0;
  if (given.count("lenient") && given.count("strict"))
    throw UsageError("--lenient and --strict exclude each other");
  if (given.count("lenient")) options.load.lenient = true;
  if (given.count("strict")) options.load.lenient = false;
  RenderSettings& render = options.render;
  take<double>(given, "spp", render.budget.spp);
  take<double>(given, "time", render.budget.seconds);
  take<double>(given, "error", render.budget.error);
  take<uint64_t>(given, "seed", render.seed);
  take<uint64_t>(given, "threads", render.threads);
  text("aovs", options.aovs);
  options.light.groups = given.count("light_groups") > 0;
  options.light.classes = all<Assignments::value_type>(given, "light_layers");
  render.alpha = given.count("alpha") > 0;
  text("checkpoint", options.checkpoint.path);
  take<double>(given, "every", options.checkpoint.every);
  options.checkpoint.overwrite = given.count("overwrite") > 0;
  text("resume", options.resume);
  if (options.checkpoint.path.empty()) options.checkpoint.path = options.resume;
  if (const auto found = given.find("exposure"); found != given.end()) {
    const double* stops = std::get_if<double>(&found->second.back());
    options.exposure = stops ? std::optional(*stops) : std::nullopt;
  }
  options.quiet = given.count("quiet") > 0;
  check_files(files_of(given));
  return options;
}

}  // namespace mlt
