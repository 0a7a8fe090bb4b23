#include "job/json.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace mlt {
namespace {

struct Writer {
  std::string operator()(std::monostate) const { return "null"; }
  std::string operator()(const ObjectPtr&) const { return "null"; }
  std::string operator()(const Buffer&) const { return "null"; }
  std::string operator()(bool value) const { return value ? "true" : "false"; }
  std::string operator()(int64_t value) const { return fmt::format("{}", value); }
  std::string operator()(double value) const {
    return std::isfinite(value) ? fmt::format("{}", value) : "null";
  }
  std::string operator()(const std::string& text) const { return json_string(text); }
  std::string operator()(const std::pair<double, double>& sample) const {
    return "[" + (*this)(sample.first) + ", " + (*this)(sample.second) + "]";
  }
  std::string operator()(const Keyframe& key) const {
    return "[" + (*this)(key.time) + ", " + (*this)(key.transform) + "]";
  }
  template <class Sequence>
  std::string operator()(const Sequence& sequence) const {
    std::string list;
    for (const auto& item : sequence) list += (list.empty() ? "" : ", ") + (*this)(item);
    return "[" + list + "]";
  }
};

template <class T, class Write>
std::string array(const std::vector<T>& items, Write&& write) {
  std::string out;
  for (const T& item : items) out += (out.empty() ? "\n    " : ",\n    ") + write(item);
  return "[" + out + (items.empty() ? "]" : "\n  ]");
}

/// JSON has neither infinity nor NaN.
std::string number(double value) { return Writer{}(value); }

std::string mutation(const MutationStats& m) {
  return fmt::format(
      R"({{"name": {}, "length": {}, "proposed": {}, "generated": {}, "accepted": {}, )"
      R"("mean_acceptance": {}, "image_distance": {}, "rays": {}, "failed_walks": {}, )"
      R"("failed_returns": {}, "weight": {}, "step_size": {}}})",
      json_string(m.name), m.length, m.proposed, m.generated, m.accepted, number(m.mean_acceptance),
      number(m.image_distance), m.rays, m.failed_walks, m.failed_returns, number(m.weight),
      number(m.step_size));
}

std::string stuck_chain(const StuckChain& s) {
  return fmt::format(R"({{"chain": {}, "rejections": {}, "x": {}, "y": {}, "signature": {}}})",
                     s.chain, s.rejections, number(s.x), number(s.y), json_string(s.signature));
}

std::string disagreement(const DisagreementStats& d) {
  return fmt::format(R"({{"x": {}, "y": {}, "share": {}}})", d.x, d.y, number(d.share));
}

/// Number of bytes of the character at this place, or 0 if it is no UTF-8 (RFC 3629).
size_t utf8_size(const std::string& text, size_t at) {
  const auto byte = [&](size_t i) {
    return at + i < text.size() ? static_cast<unsigned char>(text[at + i]) : 0u;
  };
  const unsigned first = byte(0), second = byte(1);
  if (first < 0x80) return 1;
  const size_t size = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4 || (first == 0xe0 && second < 0xa0) ||
      (first == 0xed && second > 0x9f) || (first == 0xf0 && second < 0x90) ||
      (first == 0xf4 && second > 0x8f))
    return 0;
  for (size_t i = 1; i < size; ++i)
    if ((byte(i) & 0xc0) != 0x80) return 0;
  return size;
}

}  // namespace

std::string json_string(const std::string& text) {
  std::string out = "\"";
  for (size_t i = 0, size = 1; i < text.size(); i += size) {
    const auto c = static_cast<unsigned char>(text[i]);
    size = std::max<size_t>(1, utf8_size(text, i));
    if (c == '"' || c == '\\')
      out += {'\\', text[i]};
    else if (c < 0x20)
      out += fmt::format("\\u{:04x}", c);
    else if (utf8_size(text, i) == 0)
      out += fmt::format("\\udc{:02x}", c);
    else
      out += text.substr(i, size);
  }
  return out + "\"";
}

std::string json_value(const Value& value) { return std::visit(Writer{}, value); }

void Json::add_text(const std::string& name, const std::string& value) {
  members_ += (members_.empty() ? "" : ", ") + json_string(name) + ": " + value;
}

std::string to_json(const Stats& s) {
  std::string out = "{\n";
  const auto line = [&](const char* name, const std::string& value) {
    out += fmt::format("{}  \"{}\": {}", out.size() > 2 ? ",\n" : "", name, value);
  };
  line("version", json_string(s.version));
  line("integrator", json_string(s.integrator));
  line("seed", fmt::format("{}", s.seed));
  line("size", fmt::format("[{}, {}]", s.width, s.height));
  line("spp_done", number(s.spp_done));
  line("seconds",
       fmt::format(R"({{"load": {}, "bootstrap": {}, "render": {}}})", number(s.seconds_load),
                   number(s.seconds_bootstrap), number(s.seconds_render)));
  line("rays",
       fmt::format(R"({{"intersect": {}, "occluded": {}}})", s.rays_intersect, s.rays_occluded));
  line("ended_by", json_string(s.ended_by));
  line("groups", fmt::format("{}", s.groups));
  line("error", number(s.error));
  line("block_error", number(s.block_error));
  line("pixels_carrying_error", number(s.pixels_carrying_error));
  line("disagreements", array(s.disagreements, disagreement));
  line("b", number(s.b));
  line("b_error", number(s.b_error));
  line("level_error", number(s.level_error));
  line("independent_share", number(s.independent_share));
  line("independent", json_string(s.independent));
  line("independent_samples", fmt::format("{}", s.independent_samples));
  line("samples_carrying_half", fmt::format("{}", s.samples_carrying_half));
  line("tours", fmt::format("{}", s.tours));
  line("longest_tour", fmt::format("{}", s.longest_tour));
  line("tours_waiting", number(s.tours_waiting));
  line("invalid_samples", fmt::format("{}", s.invalid_samples));
  line("stuck", array(s.stuck, stuck_chain));
  line("mutations", array(s.mutations, mutation));
  line("warnings", array(s.warnings, json_string));
  return out + "\n}\n";
}

}  // namespace mlt
