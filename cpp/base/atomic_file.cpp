#include "base/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>
#include <system_error>
#include <utility>

#include <fmt/format.h>

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

/// How /proc names an open file of this process.
std::string link_of(int file) { return "/proc/self/fd/" + std::to_string(file); }

/// A file without a name, which a process that is killed does not leave behind; -1 where the file
/// system or a missing /proc does not allow it.
int open_unnamed(const fs::path& folder, mode_t mode) {
  const int file = ::open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, mode);
  if (file >= 0 && ::access(link_of(file).c_str(), F_OK) != 0) {
    ::close(file);
    return -1;
  }
  return file;
}

/// Calls `make` with names in the folder that are not taken, until one works.
template <class Make>
std::string with_new_name(const fs::path& folder, Make&& make) {
  std::random_device random;
  for (int attempt = 0; attempt < 1000; ++attempt) {
    std::string name = (folder / fmt::format(".partial-{:08x}{:08x}", random(), random())).string();
    if (make(name.c_str()) >= 0) return name;
    if (errno != EEXIST) break;
  }
  return "";
}

/// So that the new name of a file survives a loss of power, where the file system can promise it.
void sync_folder(const fs::path& folder) {
  const int file = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (file < 0) return;
  ::fsync(file);
  ::close(file);
}

}  // namespace

AtomicFile::AtomicFile(const std::string& path) : path_(path), target_(resolve(path)) {
  folder_ = target_.has_parent_path() ? target_.parent_path() : fs::path(".");
  if (!fs::is_directory(folder_))
    throw FileError(path + ": cannot write it: there is no folder '" + folder_.string() + "'");
  struct stat old;
  const bool replaces = ::stat(target_.c_str(), &old) == 0;
  const mode_t mode = replaces ? old.st_mode & 0777 : 0666;
  int file = open_unnamed(folder_, mode);
  if (file < 0)
    name_ = with_new_name(folder_, [&](const char* name) {
      return file = ::open(name, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
    });
  if (file < 0) mlt::fail(path, "cannot write into folder '" + folder_.string() + "'", errno);
  file_ = ::fdopen(file, "wb");
  if (!file_) {
    ::close(file);
    if (!name_.empty()) ::unlink(name_.c_str());
    fail();
  }
  if (replaces) ::fchmod(file, mode);
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
  if (name_.empty())
    name_ = with_new_name(folder_, [&](const char* name) {
      return ::linkat(AT_FDCWD, link_of(::fileno(file_)).c_str(), AT_FDCWD, name,
                      AT_SYMLINK_FOLLOW);
    });
  if (name_.empty() || ::rename(name_.c_str(), target_.c_str()) != 0) fail();
  name_.clear();
  sync_folder(folder_);
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
  std::string bytes;
  try {
    bytes.resize(static_cast<size_t>(size));
  } catch (const std::exception&) {  // bad_alloc, or length_error
    throw FileError(path + ": cannot read it: there is no memory for its " + std::to_string(size) +
                    " bytes");
  }
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
