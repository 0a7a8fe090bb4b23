#include "image/jpeg_format.h"

#include "base/error.h"

#include <cstdio>  // jpeglib.h needs it

#include <jerror.h>
#include <jpeglib.h>

#include <csetjmp>
#include <cstdlib>

namespace mlt {
namespace {

/// The most scans that are decoded: each costs as much as the whole image, but few bytes of file.
constexpr int most_scans = 500;

/// Calls of libjpeg with a state of it, a jpeg_decompress_struct or a jpeg_compress_struct.
template <class Info>
class JpegCalls {
 public:
  JpegCalls() {
    info_.err = jpeg_std_error(&errors_);
    info_.client_data = this;
    errors_.error_exit = [](j_common_ptr info) { self(info).leave(info); };
    errors_.output_message = [](j_common_ptr) {};
  }
  ~JpegCalls() { jpeg_destroy(reinterpret_cast<j_common_ptr>(&info_)); }
  JpegCalls(const JpegCalls&) = delete;
  JpegCalls& operator=(const JpegCalls&) = delete;

 protected:
  static JpegCalls& self(j_common_ptr info) { return *static_cast<JpegCalls*>(info->client_data); }

  [[noreturn]] void leave(j_common_ptr info) {
    char reason[JMSG_LENGTH_MAX];
    errors_.format_message(info, reason);
    std::snprintf(message_, sizeof message_, "libjpeg reports '%s'", reason);
    std::longjmp(escape_, 1);
  }
  [[noreturn]] void leave(const char* reason) {
    std::snprintf(message_, sizeof message_, "%s", reason);
    std::longjmp(escape_, 1);
  }

  /// Calls libjpeg, whose errors leave it by longjmp: no code in between may hold objects.
  template <class Calls>
  void run(const Calls& calls) {
    if (setjmp(escape_) == 0) return calls();
    throw std::runtime_error(message_);
  }

  jpeg_error_mgr errors_{};
  Info info_{};

 private:
  char message_[JMSG_LENGTH_MAX + 40] = "";
  std::jmp_buf escape_;
};

class JpegReader : JpegCalls<jpeg_decompress_struct> {
 public:
  explicit JpegReader(std::string_view bytes) : size_(bytes.size()) {
    errors_.emit_message = [](j_common_ptr info, int level) {
      // libjpeg would invent missing data; other warnings are harmless
      const int code = info->err->msg_code;
      if (level < 0 && (code == JWRN_JPEG_EOF || code == JWRN_HIT_MARKER)) self(info).leave(info);
    };
    progress_.progress_monitor = [](j_common_ptr info) {
      if (reinterpret_cast<j_decompress_ptr>(info)->input_scan_number <= most_scans) return;
      self(info).leave("it has too many scans");
    };
    run([&] {
      jpeg_create_decompress(&info_);
      info_.progress = &progress_;
      jpeg_mem_src(&info_, reinterpret_cast<const unsigned char*>(bytes.data()),
                   static_cast<unsigned long>(bytes.size()));
    });
  }
  DecodedImage read() {
    run([&] { jpeg_read_header(&info_, TRUE); });
    constexpr int64_t per_byte = 1024;  // a progressive file has 8 blocks of 64 in a byte
    check_size(info_.image_width, info_.image_height, per_byte, size_);
    const bool four = info_.num_components == 4, grey = info_.num_components == 1;
    info_.out_color_space = four ? JCS_CMYK : grey ? JCS_GRAYSCALE : JCS_RGB;
    run([&] { jpeg_start_decompress(&info_); });
    DecodedImage result;
    result.image = Image(static_cast<int>(info_.output_width),
                         static_cast<int>(info_.output_height), grey ? 1 : 3);
    std::vector<JSAMPLE> row(size_t{info_.output_width} *
                             static_cast<size_t>(info_.output_components));
    JSAMPROW rows[] = {row.data()};
    float* target = result.image.data.data();
    while (info_.output_scanline < info_.output_height) {
      run([&] { jpeg_read_scanlines(&info_, rows, 1); });
      target = four ? convert_cmyk(row, target) : convert(row, target);
    }
    run([&] { jpeg_finish_decompress(&info_); });
    return result;
  }

 private:
  static JpegReader& self(j_common_ptr info) {
    return static_cast<JpegReader&>(*static_cast<JpegCalls*>(info->client_data));
  }

  static float* convert(const std::vector<JSAMPLE>& row, float* target) {
    for (const JSAMPLE sample : row) *target++ = static_cast<float>(sample / 255.0);
    return target;
  }

  /// Converts a row of CMYK; files by Adobe have the inks inverted.
  float* convert_cmyk(const std::vector<JSAMPLE>& row, float* target) const {
    const auto light = [&](JSAMPLE ink) { return info_.saw_Adobe_marker ? ink : 255 - ink; };
    for (size_t i = 0; i < row.size(); i += 4)
      for (size_t c = 0; c < 3; ++c)
        *target++ = static_cast<float>(light(row[i + c]) * light(row[i + 3]) / (255.0 * 255.0));
    return target;
  }

  size_t size_;
  jpeg_progress_mgr progress_{};
};

class JpegWriter : JpegCalls<jpeg_compress_struct> {
 public:
  JpegWriter(int width, int height, int channels) {
    constexpr int quality = 95;
    run([&] {
      jpeg_create_compress(&info_);
      jpeg_mem_dest(&info_, &bytes_, &size_);
      info_.image_width = static_cast<JDIMENSION>(width);
      info_.image_height = static_cast<JDIMENSION>(height);
      info_.input_components = channels;
      info_.in_color_space = channels == 1 ? JCS_GRAYSCALE : JCS_RGB;
      jpeg_set_defaults(&info_);
      jpeg_set_quality(&info_, quality, TRUE);
      info_.comp_info[0].h_samp_factor = info_.comp_info[0].v_samp_factor = 1;
      jpeg_start_compress(&info_, TRUE);
    });
  }
  ~JpegWriter() { std::free(bytes_); }
  JpegWriter(const JpegWriter&) = delete;
  JpegWriter& operator=(const JpegWriter&) = delete;

  void write(const unsigned char* samples) {
    JSAMPROW rows[] = {const_cast<JSAMPROW>(samples)};
    run([&] { jpeg_write_scanlines(&info_, rows, 1); });
  }
  std::string take() {
    run([&] { jpeg_finish_compress(&info_); });
    return {reinterpret_cast<const char*>(bytes_), size_};
  }

 private:
  unsigned char* bytes_ = nullptr;
  unsigned long size_ = 0;
};

}  // namespace

DecodedImage decode_jpeg(std::string_view bytes, const std::string& name) {
  return decode_as("JPEG", name, [&] { return JpegReader(bytes).read(); });
}

std::string encode_jpeg(int width, int height, int channels,
                        const std::function<const unsigned char*(int y)>& row) {
  const auto fits = [](int side) { return side > 0 && side <= JPEG_MAX_DIMENSION; };
  if ((channels != 1 && channels != 3) || !fits(width) || !fits(height))
    throw UsageError(fmt::format(
        "JPEG holds 1 or 3 channels and at most {0} x {0} pixels, not {1} x {2} with {3} channels; "
        "use PNG",
        JPEG_MAX_DIMENSION, width, height, channels));
  JpegWriter writer(width, height, channels);
  for (int y = 0; y < height; ++y) writer.write(row(y));
  return writer.take();
}

}  // namespace mlt
