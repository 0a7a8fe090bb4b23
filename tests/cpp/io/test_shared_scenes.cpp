// Scenes of other people, if they lie beside the repository: each one loads, or is refused in one
// line that names what is missing.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "io/load.h"
#include "job/plugins.h"

namespace mlt {
namespace {

namespace fs = std::filesystem;

fs::path shared_scenes() {
  const char* given = std::getenv("PYMLT_SHARED");
  return fs::path(given ? given : "../shared") / "scenes";
}

/// All XML files but fragments, which are no scenes of their own.
std::vector<fs::path> scene_files(const fs::path& root) {
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root))
    if (const fs::path folder = entry.path().parent_path().filename();
        entry.path().extension() == ".xml" && folder != "fragments" && folder != "include")
      files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

TEST(SharedScenes, LoadOrAreRefusedByName) {
  const fs::path root = shared_scenes();
  if (!fs::is_directory(root)) GTEST_SKIP() << "there are no scenes in " << root;
  size_t loaded = 0;
  for (const fs::path& file : scene_files(root)) {
    try {
      const LoadedScene scene = load_file(file.string(), plugins(), {});
      EXPECT_FALSE(scene.scene->emitters().empty()) << file;
      EXPECT_NE(scene.hash, 0u) << file;
      ++loaded;
    } catch (const Error& error) {
      const std::string message = error.what();
      EXPECT_NE(message.find(".xml:"), std::string::npos) << message;
      // One is of a program whose normal maps name their image themselves.
      const std::string foreign = "unknown parameter 'filename' for bsdf 'normalmap'";
      EXPECT_TRUE(message.find("' is not supported: ") != std::string::npos ||
                  message.find(foreign) != std::string::npos)
          << message;
      EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    }
  }
  EXPECT_GE(loaded, 10u);
}

}  // namespace
}  // namespace mlt
