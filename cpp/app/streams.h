// The standard streams of mlt-render. Text to a terminal that has gone, or to a full disk, is lost;
// the render is not.
#pragma once

#include <fmt/format.h>

#include <string>

namespace mlt {

/// Opens the standard streams that are closed, so that no other file takes the number of one.
void open_standard_streams();

/// Writes to stderr, and ignores errors.
void write_to_stderr(const std::string& text);

/// Prints one line on stderr.
template <class... Arguments>
void say(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
  write_to_stderr("mlt-render: " + fmt::format(format, std::forward<Arguments>(arguments)...) +
                  "\n");
}

}  // namespace mlt
