#include "app/built_in_scenes.h"

#include <algorithm>
#include <filesystem>
#include <vector>

namespace mlt {
namespace {

namespace fs = std::filesystem;

/// Folders of the scenes: installed beside the program, by CMake or in the Python package, which
/// may hold the program too; or in the sources that it was built from.
std::vector<fs::path> folders() {
  std::error_code error;
  const fs::path root = fs::read_symlink("/proc/self/exe", error).parent_path().parent_path();
  std::vector<fs::path> found = {root / "share" / "pymlt" / "scenes",
                                 root / "pymlt" / "scene_files"};
  for (const auto& entry : fs::directory_iterator(root / "lib", error))
    if (entry.path().filename().string().rfind("python", 0) == 0)
      found.push_back(entry.path() / "site-packages" / "pymlt" / "scene_files");
#ifdef MLT_SCENES
  found.emplace_back(MLT_SCENES);
#endif
  return found;
}

}  // namespace

std::string scene_file(const std::string& scene) {
  std::error_code error;
  if (fs::exists(scene, error) || scene.find_first_of("/.") != std::string::npos) return scene;
  std::string name = scene;
  std::replace(name.begin(), name.end(), '_', '-');
  for (const fs::path& folder : folders()) {
    const fs::path file = folder / name / "scene.xml";
    if (fs::exists(file, error)) return file.string();
  }
  return scene;
}

}  // namespace mlt
