#include "image/stb_formats.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <stdexcept>

// A failed assertion inside stb means a bad file, and must not abort; memory that a short file
// leaves unwritten is zero, not uninitialised.
#define STBI_ASSERT(x) ((x) ? void() : throw std::runtime_error("it is corrupt"))
#define STBI_MALLOC(size) std::calloc(1, size)
#define STBI_REALLOC(pointer, size) std::realloc(pointer, size)
#define STBI_FREE(pointer) std::free(pointer)
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_BMP
#define STBI_ONLY_TGA
#define STBI_ONLY_HDR
#define STBI_NO_STDIO
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#pragma GCC diagnostic ignored "-Wsign-compare"
#include <stb/stb_image.h>
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

namespace mlt {
namespace {

/// Feeds stb and records whether it read beyond the end: stb itself reads on in zeros.
class StbReader {
 public:
  explicit StbReader(std::string_view bytes) : bytes_(bytes) {}

  bool ended_early() const { return ended_early_; }

  static constexpr stbi_io_callbacks callbacks() {
    return {[](void* self, char* target, int count) {
              return static_cast<StbReader*>(self)->read(target, count);
            },
            [](void* self, int count) { static_cast<StbReader*>(self)->skip(count); },
            [](void* self) { return static_cast<StbReader*>(self)->at_end(); }};
  }

 private:
  int read(char* target, int count) {
    const size_t left = bytes_.size() - position_;
    const size_t size = std::min(left, static_cast<size_t>(count));
    if (size > 0) std::memcpy(target, bytes_.data() + position_, size);
    position_ += size;
    // stb fills its own buffer first, and again when it needs a byte more: less than was asked for
    // is then enough, nothing is not. Any other request goes to a pixel buffer and must be met.
    if (!stb_buffer_) stb_buffer_ = target;
    const bool refill = target == stb_buffer_;
    if (size == 0 || (!refill && size < static_cast<size_t>(count))) ended_early_ = true;
    if (size > 0 || !refill) return static_cast<int>(size);
    // After the end of the file stb would go on with zeros, and would never finish an HDR run of
    // length 0. Newlines end a header, and are runs with a length.
    std::memset(target, '\n', static_cast<size_t>(count));
    return count;
  }

  void skip(int count) {
    const size_t left = bytes_.size() - position_, size = static_cast<size_t>(count);
    if (size > left) ended_early_ = true;
    position_ += std::min(size, left);
  }

  int at_end() const { return position_ >= bytes_.size() ? 1 : 0; }

  std::string_view bytes_;
  size_t position_ = 0;
  const char* stb_buffer_ = nullptr;
  bool ended_early_ = false;
};

struct Free {
  void operator()(void* pointer) const { std::free(pointer); }
};

template <class Sample>
void copy_samples(const Sample* samples, double scale, std::vector<float>* data) {
  for (size_t i = 0; i < data->size(); ++i)
    (*data)[i] = static_cast<float>(static_cast<double>(samples[i]) / scale);
}

[[noreturn]] void fail_as_stb() {
  const char* reason = stbi_failure_reason();
  throw std::runtime_error(std::string("stb_image reports '") + (reason ? reason : "unknown") +
                           "'");
}

DecodedImage decode(std::string_view bytes, StbFormat format) {
  const stbi_io_callbacks callbacks = StbReader::callbacks();
  int width = 0, height = 0, channels = 0;
  StbReader info_reader(bytes);
  if (!stbi_info_from_callbacks(&callbacks, &info_reader, &width, &height, &channels))
    fail_as_stb();
  constexpr int64_t per_byte = 1024;  // more than any run of these formats
  check_size(width, height, per_byte, bytes.size());

  const bool hdr = format == StbFormat::hdr;
  StbReader reader(bytes);
  std::unique_ptr<void, Free> samples;
  if (hdr)
    samples.reset(stbi_loadf_from_callbacks(&callbacks, &reader, &width, &height, &channels, 0));
  else
    samples.reset(stbi_load_from_callbacks(&callbacks, &reader, &width, &height, &channels, 0));
  if (reader.ended_early()) throw std::runtime_error("the file ends early");
  if (!samples) fail_as_stb();

  DecodedImage result{Image(width, height, channels), hdr ? 32 : 8};
  if (hdr)
    copy_samples(static_cast<const float*>(samples.get()), 1, &result.image.data);
  else
    copy_samples(static_cast<const stbi_uc*>(samples.get()), 255, &result.image.data);
  return result;
}

void append(void* target, void* data, int size) {
  static_cast<std::string*>(target)->append(static_cast<const char*>(data),
                                            static_cast<size_t>(size));
}

}  // namespace

DecodedImage decode_stb(std::string_view bytes, StbFormat format, const std::string& name) {
  static const char* const names[] = {"BMP", "TGA", "HDR"};
  return decode_as(names[static_cast<size_t>(format)], name, [&] { return decode(bytes, format); });
}

std::string encode_hdr(const Image& image) {
  std::vector<float> samples(image.data.size());
  std::transform(image.data.begin(), image.data.end(), samples.begin(),
                 [](float v) { return v > 0 ? std::min(v, 1e38f) : 0.0f; });
  std::string bytes;
  if (!stbi_write_hdr_to_func(append, &bytes, image.width, image.height, image.channels,
                              samples.data()))
    throw FileError("HDR: encoding failed: out of memory");
  return bytes;
}

}  // namespace mlt
