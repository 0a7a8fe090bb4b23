// The flags of mlt-render and of `pymlt render`: one table, from which both programs make their
// parsers, and the rules that both apply to what was given.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace mlt {

using FlagValue = std::variant<std::string, uint64_t, double, std::pair<int, int>,
                               std::pair<std::string, std::string>>;

/// A type of the values of flags.
struct FlagType {
  const char* expected;  ///< For messages: "a positive number".
  std::optional<FlagValue> (*parse)(const std::string& text);
};

struct Flag {
  enum Trait : unsigned {
    required = 1,
    repeatable = 2,
    fixed_by_resume = 4,  ///< Stored in checkpoints, so it cannot be given beside --resume.
    python_only = 8,      ///< pymlt has it, mlt-render has not.
    file = 16             ///< Its value is the name of a file.
  };

  const char* name;      ///< Key of its value in FlagValues.
  const char* spelling;  ///< "-o,--output"; a positional one has no dash.
  const char* metavar;   ///< Name of its value in --help.
  const FlagType* type;  ///< Null for a flag without a value.
  const char* help;
  unsigned traits = 0;
  const char* needs = "";  ///< The name of another flag that has to be given with it.

  bool is(Trait trait) const { return (traits & trait) != 0; }
};

/// All flags, in the order of --help.
const std::vector<Flag>& render_flags();

/// The given values by the names of the flags; a flag without a value has an empty text.
using FlagValues = std::map<std::string, std::vector<FlagValue>>;

/// Parses the value of a flag. Throws UsageError.
FlagValue read_flag(const Flag& flag, const std::string& text);

/// Throws UsageError if two flags with Flag::file, with these texts, name the same file. A render
/// that is resumed may renew its checkpoint.
void check_files(const std::map<std::string, std::vector<std::string>>& given);

/// Throws UsageError if the flags with these names, and no others, are inconsistent. With --resume
/// the checkpoint fixes what is rendered: only budgets, threads, outputs and the place of the scene
/// may be given.
void check_flags(const std::set<std::string>& given);

}  // namespace mlt
