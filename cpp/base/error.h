// Typed exceptions. Every message says, on one line, what is wrong, where, and what is right.
#pragma once

#include <fmt/core.h>

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace mlt {

/// `text` with a space for each control character, which a file's name may hold too.
std::string on_one_line(std::string_view text);

class Error : public std::runtime_error {
 public:
  explicit Error(const std::string& message) : std::runtime_error(on_one_line(message)) {}
};

/// A mistake in a scene, a file it names, or a parameter. Exit code 2.
class SceneError : public Error {
 public:
  using Error::Error;
};

/// A mistake in how a program or function was called. Exit code 2.
class UsageError : public Error {
 public:
  using Error::Error;
};

/// A file that cannot be read or written. Exit code 2.
class FileError : public Error {
 public:
  using Error::Error;
};

/// The render itself failed. Exit code 3.
class RenderError : public Error {
 public:
  using Error::Error;
};

/// A place in an input file; `line` 0 means "the whole file".
struct Location {
  std::string file;
  int line = 0;
};

/// The location in words: "scene.xml:12" or "scene.xml", or "" if the object came from no file.
std::string describe(const Location& location);

/// Prefixes a message: "scene.xml:12: message", or just the message when there is no location.
std::string at(const Location& location, const std::string& message);
/// Prefixes a message that fmt::format makes, as above.
template <class First, class... Rest>
std::string at(const Location& location, const char* format, const First& first,
               const Rest&... rest) {
  return at(location, fmt::format(fmt::runtime(format), first, rest...));
}

/// The candidate that `word` was probably meant to be (edit distance), or "" if none is near.
std::string closest(const std::string& word, const std::vector<std::string>& candidates);

/// The end of a message: "; did you mean 'max_depth'?", or "; valid are: a, b, c" if none is near.
std::string suggestion(const std::string& word, const std::vector<std::string>& candidates);

}  // namespace mlt
