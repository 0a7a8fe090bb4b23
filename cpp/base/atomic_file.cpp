#include "base/atomic_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <utility>

#include "base/error.h"

namespace mlt {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& path, const std::string& what, int error) {
  throw FileError(path + ": " + what + ": " + std::strerror(error));
}

/// The file that `path` refers to: links are followed, and an existing file must be replaceable.
fs::path resolve(const std::string& path) {
  if (path.empty()) throw FileError("cannot write a file whose name is empty");
  std::error_code error;
  const fs::file_status link = fs::symlink_status(path, error);
  if (link.type() == fs::file_type::not_found) {
    if (path.back() == '/') throw FileError(path + ": cannot write it: it names a folder");
    return path;
  }
  if (error) mlt::fail(path, "cannot write it", error.value());
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::directory)
    throw FileError(path + ": cannot write it: it is a folder");
  if (status.type() == fs::file_type::not_found)
    throw FileError(path + ": cannot write it: it is a link that leads nowhere");
  if (status.type() != fs::file_type::regular)
    throw FileError(path + ": cannot write it: it exists and is not a regular file");
  if (::access(path.c_str(), W_OK) != 0) mlt::fail(path, "cannot replace it", errno);
  const fs::path target = fs::canonical(path, error);
  if (error) mlt::fail(path, "cannot write it", error.value());
  return target;
}

constexpr std::string_view partial = ".partial-";

/// Whether the file, which was just made, is this process's own: locked, and not removed meanwhile
/// by another one that took it for a remnant.
bool claim(int file) {
  struct stat status;
  return ::flock(file, LOCK_EX | LOCK_NB) == 0 && ::fstat(file, &status) == 0 &&
         status.st_nlink > 0;
}

/// Removes the files that killed processes have left: a process that is alive holds their lock.
void remove_remnants(const fs::path& folder) {
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
    if (entry.path().filename().string().compare(0, partial.size(), partial) != 0) continue;
    const int file = ::open(entry.path().c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (file < 0) continue;
    struct stat status;
    if (::fstat(file, &status) == 0 && S_ISREG(status.st_mode) &&
        ::flock(file, LOCK_EX | LOCK_NB) == 0)
      ::unlink(entry.path().c_str());
    ::close(file);
  }
}

}  // namespace

AtomicFile::AtomicFile(const std::string& path) : path_(path), target_(resolve(path)) {
  const fs::path folder = target_.has_parent_path() ? target_.parent_path() : fs::path(".");
  if (!fs::is_directory(folder))
    throw FileError(path + ": cannot write it: there is no folder '" + folder.string() + "'");
  remove_remnants(folder);
  struct stat old;
  const bool replaces = ::stat(target_.c_str(), &old) == 0;
  const std::string stem = std::string(partial) + std::to_string(::getpid()) + "-";
  int file = -1;
  for (int attempt = 0; file < 0 && attempt < 1000; ++attempt) {
    name_ = (folder / (stem + std::to_string(attempt))).string();
    file = ::open(name_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC,
                  replaces ? old.st_mode & 0777 : 0666);
    if (file < 0 && errno != EEXIST) break;
    if (file >= 0 && !claim(file)) ::close(std::exchange(file, -1));
  }
  if (file < 0) mlt::fail(path, "cannot write into folder '" + folder.string() + "'", errno);
  file_ = ::fdopen(file, "wb");
  if (!file_) {
    ::close(file);
    ::unlink(name_.c_str());
    fail();
  }
  if (replaces) ::fchmod(file, old.st_mode & 0777);
}

AtomicFile::~AtomicFile() {
  if (file_) std::fclose(file_);
  if (!name_.empty()) ::unlink(name_.c_str());
}

void AtomicFile::fail() const { mlt::fail(path_, "cannot write it", errno); }

void AtomicFile::write(std::string_view bytes) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size()) fail();
}

void AtomicFile::seek(uint64_t position) {
  if (::fseeko(file_, static_cast<off_t>(position), SEEK_SET) != 0) fail();
}

uint64_t AtomicFile::position() {
  const off_t position = ::ftello(file_);
  if (position < 0) fail();
  return static_cast<uint64_t>(position);
}

void AtomicFile::commit() {
  if (std::fflush(file_) != 0) fail();
  if (::fsync(::fileno(file_)) != 0 && errno != EINVAL && errno != EROFS) fail();
  if (::rename(name_.c_str(), target_.c_str()) != 0) fail();
  name_.clear();
  if (std::fclose(std::exchange(file_, nullptr)) != 0) fail();
}

std::string read_file(const std::string& path, uint64_t largest) {
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
  if (size > largest)
    throw FileError(path + ": cannot read it: it has more than " + std::to_string(largest) +
                    " bytes");
  std::string bytes(static_cast<size_t>(size), '\0');
  file.read(bytes.data(), static_cast<std::streamsize>(size));
  if (static_cast<uintmax_t>(file.gcount()) != size)
    throw FileError(path + ": cannot read it: it ended early");
  return bytes;
}

bool is_stream(const std::string& path) {
  std::error_code error;
  const fs::file_type type = fs::status(path, error).type();
  return type == fs::file_type::fifo || type == fs::file_type::character ||
         type == fs::file_type::socket;
}

std::string read_stream(const std::string& path) {
  constexpr size_t most = size_t{1} << 30;
  std::ifstream file(path, std::ios::binary);
  if (!file) fail(path, "cannot read it", errno);
  std::string bytes;
  for (char block[65536]; file.read(block, sizeof block), file.gcount() > 0;) {
    bytes.append(block, static_cast<size_t>(file.gcount()));
    if (bytes.size() > most) throw FileError(path + ": cannot read it: it does not end");
  }
  return bytes;
}

void write_file(const std::string& path, std::string_view bytes) {
  AtomicFile file(path);
  file.write(bytes);
  file.commit();
}

void check_file_writable(const std::string& path) { AtomicFile probe(path); }

}  // namespace mlt
