// A lock that lets one process at a time keep its state in a file.
#pragma once

#include <memory>
#include <string>

namespace mlt {

/// A lock that is held until it is destroyed, or until the process ends in whatever way. It locks
/// the file PATH.lock, which is removed when the lock is destroyed, if a lock has made it: a file
/// of that name with other content stays as it is.
class FileLock {
 public:
  /// The lock of a file, which is shared within one process. Throws FileError if another process
  /// holds it.
  static std::shared_ptr<FileLock> of(const std::string& path);

  ~FileLock();
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

 private:
  FileLock(const std::string& path, std::string name);

  std::string name_;
  int file_ = -1;
  bool ours_ = false;  ///< The file was made by a lock.
};

}  // namespace mlt
