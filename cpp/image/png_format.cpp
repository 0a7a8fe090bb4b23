#include "image/png_format.h"

#include <png.h>

#include <csetjmp>
#include <cstring>
#include <exception>

namespace mlt {
namespace {

/// Receives libpng's errors. They leave it by longjmp: no code in between may hold objects.
struct Guard {
  char message[200] = "";
  std::exception_ptr failure;  ///< Thrown by a function that libpng called.

  static void error(png_structp png, png_const_charp message) {
    auto* guard = static_cast<Guard*>(png_get_error_ptr(png));
    std::strncpy(guard->message, message, sizeof guard->message - 1);
    png_longjmp(png, 1);
  }
  static void ignore(png_structp, png_const_charp) {}

  template <class Calls>
  void run(png_structp png, const Calls& calls) {
    if (setjmp(png_jmpbuf(png)) == 0) return calls();
    if (failure) std::rethrow_exception(failure);
    throw std::runtime_error(std::string("libpng reports '") + message + "'");
  }
};

struct Source {
  std::string_view rest;

  static void read(png_structp png, png_bytep target, size_t count) {
    auto* source = static_cast<Source*>(png_get_io_ptr(png));
    if (count > source->rest.size()) png_error(png, "the file ends early");
    std::memcpy(target, source->rest.data(), count);
    source->rest.remove_prefix(count);
  }
};

class PngReader {
 public:
  explicit PngReader(std::string_view bytes)
      : size_(bytes.size()),
        source_{bytes},
        png_(png_create_read_struct(PNG_LIBPNG_VER_STRING, &guard_, Guard::error, Guard::ignore)),
        info_(png_ ? png_create_info_struct(png_) : nullptr) {
    if (!info_) {
      png_destroy_read_struct(&png_, nullptr, nullptr);
      throw std::bad_alloc();
    }
    png_set_read_fn(png_, &source_, Source::read);
    // Only pixels are wanted. Other chunks may claim any length, and get memory for it.
    png_set_keep_unknown_chunks(png_, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
    png_set_user_limits(png_, PNG_UINT_31_MAX, PNG_UINT_31_MAX);  // see check_size
  }
  ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;

  DecodedImage read() {
    guard_.run(png_, [&] { png_read_info(png_, info_); });
    constexpr int64_t per_byte = 8 * 1032;  // deflate at its best, of pixels with one bit
    check_size(png_get_image_width(png_, info_), png_get_image_height(png_, info_), per_byte,
               size_);
    guard_.run(png_, [&] {
      png_set_expand(png_);  // palettes, fewer than 8 bits, and a transparent colour
      png_set_interlace_handling(png_);
      png_read_update_info(png_, info_);
    });
    DecodedImage result;
    result.bits = png_get_bit_depth(png_, info_);
    result.image =
        Image(static_cast<int>(png_get_image_width(png_, info_)),
              static_cast<int>(png_get_image_height(png_, info_)), png_get_channels(png_, info_));
    read_samples(result);
    return result;
  }

 private:
  void read_samples(DecodedImage& result) {
    const size_t row = png_get_rowbytes(png_, info_);
    const auto height = static_cast<size_t>(result.image.height);
    std::vector<unsigned char> samples(row * height);
    std::vector<png_bytep> rows(height);
    for (size_t y = 0; y < height; ++y) rows[y] = &samples[y * row];
    guard_.run(png_, [&] {
      png_read_image(png_, rows.data());
      png_read_end(png_, nullptr);
    });
    std::vector<float>& data = result.image.data;
    for (size_t i = 0; i < data.size(); ++i)
      data[i] = result.bits == 16
                    ? static_cast<float>((samples[2 * i] << 8 | samples[2 * i + 1]) / 65535.0)
                    : static_cast<float>(samples[i] / 255.0);
  }

  size_t size_;
  Source source_;
  Guard guard_;
  png_structp png_;
  png_infop info_;
};

void write_to_file(png_structp png, png_bytep bytes, size_t count) {
  auto* guard = static_cast<Guard*>(png_get_error_ptr(png));
  try {
    static_cast<AtomicFile*>(png_get_io_ptr(png))
        ->write({reinterpret_cast<const char*>(bytes), count});
    return;
  } catch (...) {
    guard->failure = std::current_exception();
  }
  png_error(png, "the file cannot be written");
}

void flush_nothing(png_structp) {}

}  // namespace

DecodedImage decode_png(std::string_view bytes, const std::string& name) {
  return decode_as("PNG", name, [&] { return PngReader(bytes).read(); });
}

void encode_png(AtomicFile& file, int width, int height, int channels,
                const std::function<const unsigned char*(int y)>& row) {
  static const int color_types[] = {PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA,
                                    PNG_COLOR_TYPE_RGB, PNG_COLOR_TYPE_RGB_ALPHA};
  Guard guard;
  struct Writer {
    png_structp png;
    png_infop info;
    ~Writer() { png_destroy_write_struct(&png, &info); }
  } writer{png_create_write_struct(PNG_LIBPNG_VER_STRING, &guard, Guard::error, Guard::ignore),
           nullptr};
  if (writer.png) writer.info = png_create_info_struct(writer.png);
  if (!writer.info) throw std::bad_alloc();
  png_structp png = writer.png;
  guard.run(png, [&] {
    png_set_write_fn(png, &file, write_to_file, flush_nothing);
    png_set_user_limits(png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
    png_set_IHDR(png, writer.info, static_cast<png_uint_32>(width),
                 static_cast<png_uint_32>(height), 8, color_types[channels - 1], PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_write_info(png, writer.info);
  });
  for (int y = 0; y < height; ++y) {
    const unsigned char* samples = row(y);
    guard.run(png, [&] { png_write_row(png, samples); });
  }
  guard.run(png, [&] { png_write_end(png, nullptr); });
}

}  // namespace mlt
