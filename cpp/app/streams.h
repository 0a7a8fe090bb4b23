// The standard streams of mlt-render. What is said to a terminal that has gone, or to a full disk,
// is lost; the render is not.
#pragma once

#include <fmt/format.h>

#include <string>

namespace mlt {

/// Opens those of the three that are closed, so that no file of ours takes the number of one.
void open_standard_streams();

/// Writes to stderr if that can be done.
void write_to_stderr(const std::string& text);

/// One line on stderr.
template <class... Arguments>
void say(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
  write_to_stderr("mlt-render: " + fmt::format(format, std::forward<Arguments>(arguments)...) +
                  "\n");
}

}  // namespace mlt
