// Maps in TIFF files, by libtiff. Only those codecs are used that are simple and in every build of
// the library.
#include <tiffio.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "vndf/io/format_error.h"
#include "vndf/io/map_pixels.h"

namespace vndf::io {
namespace {

constexpr std::size_t kColours = 3;
constexpr std::array<std::uint16_t, 5> kCodecs{COMPRESSION_NONE, COMPRESSION_PACKBITS,
                                               COMPRESSION_LZW, COMPRESSION_ADOBE_DEFLATE,
                                               COMPRESSION_DEFLATE};
// The largest buffer that libtiff may take: a row of the widest map with 16 samples of 4 bytes is
// 1 MiB, and a strip has tens of rows.
constexpr tmsize_t kMostBytesAtOnce = tmsize_t{64} << 20;

struct Close {
  void operator()(TIFF* tiff) const { TIFFClose(tiff); }
};
using File = std::unique_ptr<TIFF, Close>;

int ignore(TIFF*, void*, const char*, const char*, va_list) {
  return 1;
}

File open(const std::filesystem::path& path) {
  const std::unique_ptr<TIFFOpenOptions, void (*)(TIFFOpenOptions*)> options(TIFFOpenOptionsAlloc(),
                                                                             TIFFOpenOptionsFree);
  TIFFOpenOptionsSetMaxSingleMemAlloc(options.get(), kMostBytesAtOnce);
  TIFFOpenOptionsSetErrorHandlerExtR(options.get(), ignore, nullptr);
  TIFFOpenOptionsSetWarningHandlerExtR(options.get(), ignore, nullptr);
  return File(TIFFOpenExt(path.c_str(), "rm", options.get()));  // m: no memory map
}

template <class T>
T field(TIFF* tiff, std::uint32_t tag) {
  T value{};
  TIFFGetFieldDefaulted(tiff, tag, &value);
  return value;
}

struct Layout {
  std::uint32_t width, height;
  std::uint16_t samples, bits;
  bool floats;

  std::size_t texel_bytes() const { return std::size_t{samples} * bits / 8; }
};

Layout layout_of(TIFF* tiff) {
  const auto number = [&](std::uint32_t tag) { return field<std::uint16_t>(tiff, tag); };
  const auto sample_format = number(TIFFTAG_SAMPLEFORMAT);
  const Layout layout{field<std::uint32_t>(tiff, TIFFTAG_IMAGEWIDTH),
                      field<std::uint32_t>(tiff, TIFFTAG_IMAGELENGTH),
                      number(TIFFTAG_SAMPLESPERPIXEL), number(TIFFTAG_BITSPERSAMPLE),
                      sample_format == SAMPLEFORMAT_IEEEFP};
  const bool whole = sample_format == SAMPLEFORMAT_UINT && (layout.bits == 8 || layout.bits == 16);
  if (number(TIFFTAG_PHOTOMETRIC) != PHOTOMETRIC_RGB || layout.samples < kColours ||
      !(whole || (layout.floats && layout.bits == 32)))
    throw FormatError("it has no colours R, G and B of 8 or 16 bits or of 32-bit floats",
                      "give an RGB image, which a normal map is");
  if (TIFFIsTiled(tiff) != 0 || number(TIFFTAG_PLANARCONFIG) != PLANARCONFIG_CONTIG)
    throw FormatError("its texels are in tiles or in planes", "write it in strips");
  if (std::ranges::find(kCodecs, number(TIFFTAG_COMPRESSION)) == kCodecs.end())
    throw FormatError("its compression is not read", "write it with LZW, Deflate or none");
  if (TIFFScanlineSize(tiff) != static_cast<tmsize_t>(layout.width * layout.texel_bytes()))
    throw FormatError("its rows have another size than its texels", "copy it again");
  return layout;
}

template <class T>
T number_at(const unsigned char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

/// A sample in the order of bytes of this machine, as libtiff returns it.
float sample_at(const Layout& layout, const unsigned char* bytes) {
  if (layout.floats) return number_at<float>(bytes);
  return layout.bits == 16 ? static_cast<float>(number_at<std::uint16_t>(bytes)) / 65535
                           : static_cast<float>(*bytes) / 255;
}

}  // namespace

MapPixels read_tiff_map(const std::filesystem::path& path) {
  const FormatError broken("libtiff finds it broken",
                           "copy it again, or write it with another program");
  const File file = open(path);
  if (!file) throw broken;
  const Layout layout = layout_of(file.get());
  check_map_size(layout.width, layout.height, std::filesystem::file_size(path));
  MapPixels pixels{.width = layout.width,
                   .height = layout.height,
                   .format = (layout.floats ? "float" : std::to_string(layout.bits) + "-bit") +
                             std::string(" TIFF"),
                   .whole_numbers = !layout.floats};
  std::vector<unsigned char> row(layout.width * layout.texel_bytes());
  for (std::uint32_t y = 0; y < layout.height; ++y) {
    if (TIFFReadScanline(file.get(), row.data(), y, 0) != 1) throw broken;
    for (std::uint32_t x = 0; x < layout.width; ++x)
      for (std::size_t c = 0; c < kColours; ++c)
        pixels.values.push_back(
            sample_at(layout, row.data() + x * layout.texel_bytes() + c * (layout.bits / 8)));
  }
  return pixels;
}

}  // namespace vndf::io
