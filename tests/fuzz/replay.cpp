// Gives every file in some folders to a target, without libFuzzer: replay_<name> FOLDER...
// Ten seconds are enough for any of them.
#include "fuzz.h"

#include "image/atomic_file.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <vector>

int main(int argc, char** argv) {
  std::vector<std::string> files;
  for (int i = 1; i < argc; ++i)
    if (std::filesystem::is_directory(argv[i]))
      for (const auto& entry : std::filesystem::directory_iterator(argv[i]))
        files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  for (const std::string& file : files) {
    std::printf("%s\n", file.c_str());
    std::fflush(stdout);
    alarm(10);
    mlt::fuzz::survive(mlt::read_file(file));
  }
  return files.empty();
}
