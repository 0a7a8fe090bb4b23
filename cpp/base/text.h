// Numbers and lists as scene files write them. Nothing here depends on the locale.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mlt {

/// The text in quotes for a message: shortened, and on one line.
std::string quote(std::string_view text);

std::string_view trim(std::string_view text);

/// The words between white space and commas, in any mixture.
std::vector<std::string_view> split(std::string_view text);

/// A finite number such as 3, -.5 or 1e-005, with nothing but white space around it.
std::optional<double> parse_real(std::string_view text);
std::optional<int64_t> parse_integer(std::string_view text);
/// Parses "true" or "false", in upper or lower case.
std::optional<bool> parse_boolean(std::string_view text);

/// A list of numbers; nullopt if one of the words is not a number.
std::optional<std::vector<double>> parse_reals(std::string_view text);
/// A list of exactly three numbers.
std::optional<std::array<double, 3>> parse_triple(std::string_view text);

}  // namespace mlt
