// Gives every file in some folders to a target, without libFuzzer: replay_<name> FOLDER...
// Ten seconds and a gigabyte are enough for any of them.
#include "fuzz.h"

#include "base/atomic_file.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace {

/// The most memory that this process has asked for so far, in kB; untouched memory counts.
long peak_memory() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
    if (long kilobytes = 0; word == "VmPeak:" && status >> kilobytes) return kilobytes;
  return 0;
}

}  // namespace

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
    const long before = peak_memory();
    mlt::fuzz::survive(mlt::read_file(file));
    if (peak_memory() - before > 1 << 20) {
      std::printf("took a gigabyte\n");
      return 1;
    }
  }
  return files.empty();
}
