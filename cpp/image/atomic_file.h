// Whole files in and out. A file is written beside its name and then renamed, so that no
// incomplete file is ever visible, and an older file stays until the new one is complete.
#pragma once

#include <string>
#include <string_view>

namespace mlt {

/// The bytes of a regular file; a FileError if it cannot be read.
std::string read_file(const std::string& path);

/// Replaces `path` by these bytes, at once or not at all; a FileError if it cannot.
void write_file(const std::string& path, std::string_view bytes);

/// Throws now the FileError that write_file(path) would end in. It tries: a file is created in the
/// folder and removed again; one that exists at `path` is not touched.
void check_file_writable(const std::string& path);

}  // namespace mlt
