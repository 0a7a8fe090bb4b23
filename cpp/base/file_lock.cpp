#include "base/file_lock.h"

#include "base/error.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <map>
#include <mutex>

namespace mlt {
namespace {

/// Whether the open file still has this name: the previous holder may have removed it.
bool still_there(int file, const std::string& name) {
  struct stat opened, named;
  return ::fstat(file, &opened) == 0 && ::stat(name.c_str(), &named) == 0 &&
         opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
}

}  // namespace

std::shared_ptr<FileLock> FileLock::of(const std::string& path) {
  static std::mutex mutex;
  static std::map<std::string, std::weak_ptr<FileLock>> held;  // a lock belongs to a process
  std::error_code ignored;
  const auto file =
      std::filesystem::weakly_canonical(std::filesystem::absolute(path, ignored), ignored);
  const std::string name = (file.empty() ? path : file.string()) + ".lock";
  const std::lock_guard lock(mutex);
  std::shared_ptr<FileLock> found = held[name].lock();
  if (!found) held[name] = found = std::shared_ptr<FileLock>(new FileLock(path, name));
  return found;
}

FileLock::FileLock(const std::string& path, std::string name) : name_(std::move(name)) {
  do {
    if (file_ >= 0) ::close(file_);
    file_ = ::open(name_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (file_ < 0)
      throw FileError(path + ": cannot lock it: " + name_ + ": " + std::strerror(errno));
    if (::flock(file_, LOCK_EX | LOCK_NB) == 0) continue;
    if (errno != EWOULDBLOCK) return;  // a file system without locks
    ::close(file_);
    throw FileError(path + ": another render keeps its state there; wait for its end, or name " +
                    "another file");
  } while (!still_there(file_, name_));
}

FileLock::~FileLock() {
  ::unlink(name_.c_str());
  ::close(file_);
}

}  // namespace mlt
