#include "app/options.h"

#include <charconv>

namespace mlt {

void check_options(const Options& options, bool seed_given, bool every_given) {
  if (options.scene.empty() && options.resume.empty())
    throw UsageError("SCENE is required, or --resume FILE; see mlt-render --help");
  if (every_given && options.checkpoint.empty() && options.resume.empty())
    throw UsageError("--every needs --checkpoint FILE");
  if (options.resume.empty()) return;
  const std::pair<const char*, bool> fixed[] = {{"--integrator", !options.integrator.empty()},
                                                {"-p", !options.parameters.empty()},
                                                {"-D", !options.load.defines.empty()},
                                                {"--size", options.load.size.has_value()},
                                                {"--seed", seed_given}};
  for (const auto& [flag, given] : fixed)
    if (given)
      throw UsageError(std::string(flag) +
                       " cannot be given with --resume: the checkpoint says it");
}

std::pair<std::string, std::string> parse_assignment(const std::string& flag,
                                                     const std::string& text) {
  const size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0)
    throw UsageError(flag + " " + text + ": expected name=value");
  return {text.substr(0, equals), text.substr(equals + 1)};
}

Vec2i parse_size(const std::string& text) {
  Vec2i size{0};
  const char* end = text.data() + text.size();
  const auto width = std::from_chars(text.data(), end, size.x);
  const bool cross = width.ec == std::errc() && width.ptr != end && *width.ptr == 'x';
  const auto height = cross ? std::from_chars(width.ptr + 1, end, size.y) : width;
  if (!cross || height.ec != std::errc() || height.ptr != end || size.x <= 0 || size.y <= 0)
    throw UsageError("--size " + text + ": expected WIDTHxHEIGHT in pixels, such as 640x360");
  return size;
}

}  // namespace mlt
