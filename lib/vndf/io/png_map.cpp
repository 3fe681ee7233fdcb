// Maps in PNG files, by libpng. Gamma and colour profiles are ignored, because the values of a
// normal map are no colours.
#include <png.h>

#include <csetjmp>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "vndf/io/format_error.h"
#include "vndf/io/map_pixels.h"

namespace vndf::io {
namespace {

constexpr std::size_t kColours = 3;
// Chunks of text, profiles and the like are passed over. libpng would allocate what they declare.
constexpr int kAllButPixels = -1;

struct Close {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

[[noreturn]] void jump(png_structp png, png_const_charp) {
  png_longjmp(png, 1);
}
void ignore(png_structp, png_const_charp) {}

/// Calls of libpng end in a jump where the file is broken. So each of them is made by a function
/// that has no object to destroy, and tells whether it came to its end.
class Reader {
 public:
  explicit Reader(std::FILE* file)
      : png_(png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, jump, ignore)),
        info_(png_ == nullptr ? nullptr : png_create_info_struct(png_)),
        file_(file) {}
  ~Reader() { png_destroy_read_struct(&png_, &info_, nullptr); }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  /// Reads what comes before the pixels.
  bool read_head() {
    if (info_ == nullptr || setjmp(png_jmpbuf(png_)) != 0) return false;
    png_set_user_limits(png_, kMaxMapSide, kMaxMapSide);
    png_set_keep_unknown_chunks(png_, PNG_HANDLE_CHUNK_NEVER, nullptr, kAllButPixels);
    png_init_io(png_, file_);
    png_read_info(png_, info_);
    return true;
  }

  std::size_t width() const { return png_get_image_width(png_, info_); }
  std::size_t height() const { return png_get_image_height(png_, info_); }
  int bits() const { return png_get_bit_depth(png_, info_); }
  bool has_colours() const {
    const int type = png_get_color_type(png_, info_);
    return type == PNG_COLOR_TYPE_RGB || type == PNG_COLOR_TYPE_RGB_ALPHA;
  }

  /// Reads all rows, without alpha, to where `rows` point.
  bool read_rows(png_bytep* rows) {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_set_strip_alpha(png_);
    png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
    png_read_image(png_, rows);
    png_read_end(png_, nullptr);
    return true;
  }

 private:
  png_structp png_;
  png_infop info_;
  std::FILE* file_;
};

[[noreturn]] void refuse_broken() {
  throw FormatError("libpng finds it broken", "copy it again, or write it with another program");
}

std::vector<png_byte> read_bytes(Reader& reader) {
  const std::size_t row_bytes =
      reader.width() * kColours * static_cast<std::size_t>(reader.bits() / 8);
  std::vector<png_byte> bytes(row_bytes * reader.height());
  std::vector<png_bytep> rows(reader.height());
  for (std::size_t row = 0; row < rows.size(); ++row) rows[row] = bytes.data() + row * row_bytes;
  if (!reader.read_rows(rows.data())) refuse_broken();
  return bytes;
}

/// Numbers of 16 bits have their high byte first.
std::vector<float> values_of(const std::vector<png_byte>& bytes, int bits) {
  std::vector<float> values;
  const std::size_t step = bits == 16 ? 2 : 1;
  values.reserve(bytes.size() / step);
  for (std::size_t i = 0; i < bytes.size(); i += step)
    values.push_back(bits == 16 ? static_cast<float>(256 * bytes[i] + bytes[i + 1]) / 65535
                                : static_cast<float>(bytes[i]) / 255);
  return values;
}

}  // namespace

MapPixels read_png_map(const std::filesystem::path& path) {
  const std::unique_ptr<std::FILE, Close> file(std::fopen(path.c_str(), "rb"));
  if (!file) throw FormatError("it cannot be read", "check its permissions");
  Reader reader(file.get());
  if (!reader.read_head()) refuse_broken();
  if (!reader.has_colours() || reader.bits() < 8)
    throw FormatError("it has no colours R, G and B of 8 or 16 bits each",
                      "give an RGB image, which a normal map is");
  check_map_size(static_cast<std::int64_t>(reader.width()),
                 static_cast<std::int64_t>(reader.height()), std::filesystem::file_size(path));
  const int bits = reader.bits();
  return {.width = reader.width(),
          .height = reader.height(),
          .format = std::to_string(bits) + "-bit PNG",
          .whole_numbers = true,
          .values = values_of(read_bytes(reader), bits)};
}

}  // namespace vndf::io
