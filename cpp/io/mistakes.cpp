#include "io/mistakes.h"

#include <algorithm>

namespace mlt {
namespace {

constexpr size_t most_told = 20;

}  // namespace

void Mistakes::add(std::string what, const Location& where) {
  if (const std::string place = on_one_line(at(where, ""));
      what.compare(0, place.size(), place) == 0)
    what.erase(0, place.size());
  if (std::none_of(found_.begin(), found_.end(),
                   [&](const Found& other) { return other.what == what; }))
    found_.push_back({where, what});
}

void Mistakes::report() const {
  if (found_.empty()) return;
  std::string message = at(found_[0].where, found_[0].what);
  for (size_t i = 1; i < std::min(found_.size(), most_told); ++i) {
    const auto& [where, what] = found_[i];
    const bool same_file = where.file == found_[0].where.file && where.line > 0;
    message += "; " + (same_file ? fmt::format("line {}: {}", where.line, what) : at(where, what));
  }
  if (found_.size() > most_told) message += fmt::format("; and {} more", found_.size() - most_told);
  throw SceneError(message);
}

}  // namespace mlt
