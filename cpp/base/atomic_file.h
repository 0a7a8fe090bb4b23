// Reading and writing whole files. A file is written under another name and then renamed, so that
// no incomplete file is ever visible, and an older file stays until the new one is complete.
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>

namespace mlt {

/// A file while it is written: a new one in the folder of its target, without a name where the file
/// system has such files, moved there by commit() and removed otherwise. One that replaces another
/// has its permissions. Everything throws FileError.
class AtomicFile {
 public:
  explicit AtomicFile(const std::string& path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(std::string_view bytes);
  void seek(uint64_t position);
  uint64_t position();
  void commit();

 private:
  [[noreturn]] void fail() const;

  std::string path_, name_;
  std::filesystem::path target_, folder_;
  std::FILE* file_ = nullptr;
};

/// The size limit of a file, in bytes; a larger one is a mistake or an attack.
constexpr uint64_t largest_file = uint64_t{1} << 32;

/// The bytes of a regular file; a FileError if it cannot be read, or is larger than `largest`.
std::string read_file(const std::string& path, uint64_t largest = largest_file);

/// Whether the path is a pipe, a terminal or the like, such as /dev/stdin.
bool is_stream(const std::string& path);

/// The bytes of a stream up to its end; a FileError if it cannot be read, or if they are more than
/// 1 GiB.
std::string read_stream(const std::string& path);

/// Replaces `path` by these bytes, at once or not at all; a FileError if it cannot.
void write_file(const std::string& path, std::string_view bytes);

/// Throws now the FileError that write_file(path) would throw. For this a file is created in the
/// folder and removed again; one that exists at `path` is not touched.
void check_file_writable(const std::string& path);

}  // namespace mlt
