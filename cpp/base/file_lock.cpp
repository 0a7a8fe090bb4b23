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
#include <string_view>

namespace mlt {
namespace {

/// What our lock files contain, and others of the same name do not.
constexpr std::string_view content = "lock of a checkpoint of pymlt\n";

bool has_content(int file) {
  char bytes[content.size() + 1];
  const ssize_t size = ::pread(file, bytes, sizeof bytes, 0);
  return size >= 0 && std::string_view(bytes, static_cast<size_t>(size)) == content;
}

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
    file_ = ::open(name_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    ours_ = file_ >= 0;
    if (!ours_ && errno == EEXIST) {
      file_ = ::open(name_.c_str(), O_RDWR | O_NOFOLLOW | O_CLOEXEC);
      if (file_ < 0 && errno == ENOENT) continue;  // its holder has just removed it
    }
    if (file_ < 0)
      throw FileError(path + ": cannot lock it: " + name_ + ": " + std::strerror(errno));
    if (::flock(file_, LOCK_EX | LOCK_NB) == 0) continue;
    if (errno != EWOULDBLOCK) break;  // a file system without locks
    ::close(file_);
    throw FileError(path + ": another render keeps its state there; wait for its end, or name " +
                    "another file");
  } while (!still_there(file_, name_));
  if (ours_)
    ours_ = ::write(file_, content.data(), content.size()) == ssize_t{content.size()};
  else
    ours_ = has_content(file_);
}

FileLock::~FileLock() {
  if (ours_) ::unlink(name_.c_str());
  ::close(file_);
}

}  // namespace mlt
