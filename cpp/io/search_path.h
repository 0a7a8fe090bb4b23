// The directories in which the files of a scene are searched.
#pragma once

#include "base/error.h"

#include <filesystem>
#include <string>
#include <vector>

namespace mlt {

class SearchPath {
 public:
  /// Adds a directory that is searched before all others; "" is the current one.
  void prepend(const std::filesystem::path& directory);

  /// The absolute name of an existing file. A name with backslashes is also tried with slashes.
  /// Throws SceneError with the directories that were searched.
  std::string find_file(const std::string& name, const Location& where) const;
  std::string find_directory(const std::string& name, const Location& where) const;

 private:
  std::string find(const std::string& name, bool directory, const Location& where) const;

  std::vector<std::filesystem::path> directories_;
};

}  // namespace mlt
