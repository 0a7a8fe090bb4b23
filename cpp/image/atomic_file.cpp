#include "image/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "base/error.h"

namespace mlt {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& path, const std::string& what, int error) {
  throw FileError(path + ": " + what + ": " + std::strerror(error));
}

/// A new file in the folder of its target: moved there by commit(), removed otherwise.
class Partial {
 public:
  explicit Partial(const std::string& path) : path_(path), target_(resolve(path)) {
    const fs::path folder = target_.has_parent_path() ? target_.parent_path() : fs::path(".");
    if (!fs::is_directory(folder))
      throw FileError(path + ": cannot write it: there is no folder '" + folder.string() + "'");
    const std::string stem = ".partial-" + std::to_string(::getpid()) + "-";
    for (int attempt = 0; file_ < 0 && attempt < 1000; ++attempt) {
      name_ = (folder / (stem + std::to_string(attempt))).string();
      file_ = ::open(name_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
      if (file_ < 0 && errno != EEXIST) break;
    }
    if (file_ < 0) fail(path, "cannot write into folder '" + folder.string() + "'", errno);
  }

  ~Partial() {
    if (file_ >= 0) ::close(file_);
    if (!committed_) ::unlink(name_.c_str());
  }
  Partial(const Partial&) = delete;
  Partial& operator=(const Partial&) = delete;

  void write(std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t count = ::write(file_, bytes.data(), bytes.size());
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) fail(path_, "cannot write it", errno);
      bytes.remove_prefix(static_cast<size_t>(count));
    }
  }

  void commit() {
    if (::fsync(file_) != 0 && errno != EINVAL && errno != EROFS)
      fail(path_, "cannot write it", errno);
    const int closed = ::close(file_);
    file_ = -1;
    if (closed != 0) fail(path_, "cannot write it", errno);
    if (::rename(name_.c_str(), target_.c_str()) != 0) fail(path_, "cannot write it", errno);
    committed_ = true;
  }

 private:
  /// The file that `path` means: links are followed, and what is there must be replaceable.
  static fs::path resolve(const std::string& path) {
    if (path.empty()) throw FileError("cannot write a file whose name is empty");
    std::error_code error;
    const fs::file_status link = fs::symlink_status(path, error);
    if (link.type() == fs::file_type::not_found) {
      if (path.back() == '/') throw FileError(path + ": cannot write it: it names a folder");
      return path;
    }
    if (error) fail(path, "cannot write it", error.value());
    const fs::file_status status = fs::status(path, error);
    if (status.type() == fs::file_type::directory)
      throw FileError(path + ": cannot write it: it is a folder");
    if (status.type() == fs::file_type::not_found)
      throw FileError(path + ": cannot write it: it is a link that leads nowhere");
    if (status.type() != fs::file_type::regular)
      throw FileError(path + ": cannot write it: it exists and is not a regular file");
    if (::access(path.c_str(), W_OK) != 0) fail(path, "cannot replace it", errno);
    const fs::path target = fs::canonical(path, error);
    if (error) fail(path, "cannot write it", error.value());
    return target;
  }

  std::string path_, name_;
  fs::path target_;
  int file_ = -1;
  bool committed_ = false;
};

}  // namespace

std::string read_file(const std::string& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found) throw FileError(path + ": there is no such file");
  if (error) fail(path, "cannot read it", error.value());
  if (status.type() == fs::file_type::directory)
    throw FileError(path + ": cannot read it: it is a folder");
  if (status.type() != fs::file_type::regular)
    throw FileError(path + ": cannot read it: it is not a regular file");
  std::ifstream file(path, std::ios::binary);
  if (!file) fail(path, "cannot read it", errno);
  const uintmax_t size = fs::file_size(path, error);
  if (error) fail(path, "cannot read it", error.value());
  std::string bytes(static_cast<size_t>(size), '\0');
  file.read(bytes.data(), static_cast<std::streamsize>(size));
  if (static_cast<uintmax_t>(file.gcount()) != size)
    throw FileError(path + ": cannot read it: it ended early");
  return bytes;
}

void write_file(const std::string& path, std::string_view bytes) {
  Partial file(path);
  file.write(bytes);
  file.commit();
}

void check_file_writable(const std::string& path) { Partial probe(path); }

}  // namespace mlt
