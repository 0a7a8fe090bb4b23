// One process at a time keeps its state in a file.
#pragma once

#include <memory>
#include <string>

namespace mlt {

/// Held until it is destroyed, or until the process ends in whatever way. It is a lock on the file
/// PATH.lock, which is there as long.
class FileLock {
 public:
  /// Within one process a file has one lock, which all who ask for it share. Throws FileError if
  /// another process has it.
  static std::shared_ptr<FileLock> of(const std::string& path);

  ~FileLock();
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

 private:
  FileLock(const std::string& path, std::string name);

  std::string name_;
  int file_ = -1;
};

}  // namespace mlt
