#include "image/jpeg_format.h"

#include <cstdio>  // jpeglib.h needs it

#include <jerror.h>
#include <jpeglib.h>

#include <csetjmp>

namespace mlt {
namespace {

/// The most scans that are decoded: each costs as much as the whole image, but few bytes of file.
constexpr int most_scans = 500;

class JpegReader {
 public:
  explicit JpegReader(std::string_view bytes) : size_(bytes.size()) {
    info_.err = jpeg_std_error(&errors_);
    info_.client_data = this;
    errors_.error_exit = [](j_common_ptr info) { self(info).leave(info); };
    errors_.output_message = [](j_common_ptr) {};
    errors_.emit_message = [](j_common_ptr info, int level) {
      // libjpeg would invent missing data; other warnings are harmless
      const int code = info->err->msg_code;
      if (level < 0 && (code == JWRN_JPEG_EOF || code == JWRN_HIT_MARKER)) self(info).leave(info);
    };
    progress_.progress_monitor = [](j_common_ptr info) {
      if (reinterpret_cast<j_decompress_ptr>(info)->input_scan_number <= most_scans) return;
      std::snprintf(self(info).message_, sizeof message_, "it has too many scans");
      std::longjmp(self(info).escape_, 1);
    };
    run([&] {
      jpeg_create_decompress(&info_);
      info_.progress = &progress_;
      jpeg_mem_src(&info_, reinterpret_cast<const unsigned char*>(bytes.data()),
                   static_cast<unsigned long>(bytes.size()));
    });
  }
  ~JpegReader() { jpeg_destroy_decompress(&info_); }
  JpegReader(const JpegReader&) = delete;
  JpegReader& operator=(const JpegReader&) = delete;

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
    return *static_cast<JpegReader*>(info->client_data);
  }

  [[noreturn]] void leave(j_common_ptr info) {
    char reason[JMSG_LENGTH_MAX];
    errors_.format_message(info, reason);
    std::snprintf(message_, sizeof message_, "libjpeg reports '%s'", reason);
    std::longjmp(escape_, 1);
  }

  /// Calls libjpeg, whose errors leave it by longjmp: no code in between may hold objects.
  template <class Calls>
  void run(const Calls& calls) {
    if (setjmp(escape_) == 0) return calls();
    throw std::runtime_error(message_);
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
  char message_[JMSG_LENGTH_MAX + 40] = "";
  std::jmp_buf escape_;
  jpeg_error_mgr errors_{};
  jpeg_progress_mgr progress_{};
  jpeg_decompress_struct info_{};
};

}  // namespace

DecodedImage decode_jpeg(std::string_view bytes, const std::string& name) {
  return decode_as("JPEG", name, [&] { return JpegReader(bytes).read(); });
}

}  // namespace mlt
