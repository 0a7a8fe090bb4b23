#include "io/search_path.h"

#include "base/text.h"

#include <fmt/format.h>

#include <algorithm>

namespace mlt {
namespace fs = std::filesystem;
namespace {

bool is_there(const fs::path& path, bool directory) {
  std::error_code error;
  return directory ? fs::is_directory(path, error) : fs::is_regular_file(path, error);
}

fs::path make_absolute(const fs::path& path) {
  std::error_code error;
  const fs::path result = fs::absolute(path, error);
  return (error ? path : result).lexically_normal();
}

}  // namespace

void SearchPath::prepend(const fs::path& directory) {
  directories_.insert(directories_.begin(), make_absolute(directory.empty() ? "." : directory));
}

std::string SearchPath::find_file(const std::string& name, const Location& where) const {
  return find(name, false, where);
}

std::string SearchPath::find_directory(const std::string& name, const Location& where) const {
  return find(name, true, where);
}

std::string SearchPath::find(const std::string& name, bool directory, const Location& where) const {
  std::vector<std::string> spellings{name};
  if (name.find('\\') != std::string::npos) {
    spellings.push_back(name);
    std::replace(spellings.back().begin(), spellings.back().end(), '\\', '/');
  }
  for (const std::string& spelling : spellings) {
    if (fs::path(spelling).is_absolute()) {
      if (is_there(spelling, directory)) return make_absolute(spelling).string();
      continue;
    }
    for (const fs::path& base : directories_)
      if (is_there(base / spelling, directory)) return make_absolute(base / spelling).string();
  }
  std::vector<std::string> looked;
  if (!fs::path(name).is_absolute())
    for (const fs::path& base : directories_) looked.push_back(base.string());
  throw SceneError(at(where, "there is no {} {}{}", directory ? "directory" : "file", quote(name),
                      looked.empty() ? "" : fmt::format(" in {}", fmt::join(looked, ", "))));
}

}  // namespace mlt
