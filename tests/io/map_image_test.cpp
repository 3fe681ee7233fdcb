// Maps in EXR, PNG and TIFF files: what is read, in which encoding, and every reason to refuse one.
#include "vndf/io/map_image.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfTiledOutputFile.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include "support/catch.h"
#include "support/image_files.h"

using namespace vndf;
using namespace vndf::test;

namespace {

struct TemporaryFile {
  std::filesystem::path path = std::filesystem::temp_directory_path() / "vndf-map-image-test";
  ~TemporaryFile() { std::filesystem::remove(path); }

  void write(const std::string& bytes) const { std::ofstream(path, std::ios::binary) << bytes; }
  std::string bytes() const {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
};

/// Writes rows of `width` texels, each with a value for every channel; the window starts at (3,
/// -2).
void write_map(const std::filesystem::path& path, const std::vector<std::string>& channels,
               int width, const std::vector<float>& values) {
  const int height = static_cast<int>(values.size() / channels.size()) / width;
  const Imath::Box2i window({3, -2}, {2 + width, height - 3});
  Imf::Header header(window, window);
  Imf::FrameBuffer frame;
  const std::size_t texel = sizeof(float) * channels.size();
  for (std::size_t c = 0; c < channels.size(); ++c) {
    header.channels().insert(channels[c], Imf::Channel(Imf::FLOAT));
    frame.insert(channels[c], Imf::Slice::Make(Imf::FLOAT, values.data() + c, window, texel,
                                               texel * static_cast<std::size_t>(width)));
  }
  Imf::OutputFile file(path.c_str(), header, 0);
  file.setFrameBuffer(frame);
  file.writePixels(height);
}

/// Numbers of `size` bytes each.
std::string wide(const std::vector<std::uint32_t>& numbers, int size = 2, bool big_endian = true) {
  std::string bytes;
  for (const std::uint32_t number : numbers) bytes += number_bytes(number, size, big_endian);
  return bytes;
}

/// The slope of a normal of which the components are shares of `largest`, shifted.
Vec2<double> shifted_slope(double x, double y, double z, double largest) {
  const auto component = [&](double v) { return 2 * v / largest - 1; };
  return {-component(x) / component(z), -component(y) / component(z)};
}
Vec2<double> n8(double x, double y, double z) {
  return shifted_slope(x, y, z, 255);
}
Vec2<double> n16(double x, double y, double z) {
  return shifted_slope(x, y, z, 65535);
}

void check_read(const std::string& bytes, const std::vector<Vec2<double>>& slopes,
                const std::string& content) {
  const TemporaryFile file;
  file.write(bytes);
  const io::SlopeImage image = io::read_slope_map(file.path);
  CHECK_THAT(image.content, contains(content));
  REQUIRE(image.slopes.size() == slopes.size());
  for (std::size_t i = 0; i < slopes.size(); ++i) {
    // Values are kept as floats.
    CHECK(image.slopes[i].x == Approx(slopes[i].x).epsilon(1e-5).margin(1e-6));
    CHECK(image.slopes[i].y == Approx(slopes[i].y).epsilon(1e-5).margin(1e-6));
  }
}

void check_refused(const std::string& bytes, const std::string& why) {
  const TemporaryFile file;
  file.write(bytes);
  CHECK_THROWS_WITH(io::read_slope_map(file.path),
                    contains("vndf-map-image-test: ") && contains(why) && contains("; "));
  CHECK_THROWS_AS(io::read_slope_map(file.path), io::MapImageError);
}

}  // namespace

TEST_CASE("normal maps in both encodings and slope maps are read alike") {
  const std::vector<float> normals{0.6f, 0, 0.8f, 0, -0.6f, 0.8f, 0, 0, 1, -0.48f, 0.36f, 0.8f};
  const std::vector<Vec2<double>> slopes{{-0.75, 0}, {0, 0.75}, {0, 0}, {0.6, -0.45}};
  std::vector<float> shifted, stored;
  for (const float v : normals) shifted.push_back((v + 1) / 2);
  for (const auto& s : slopes) stored.insert(stored.end(), {float(s.x), float(s.y)});
  const TemporaryFile file;
  const auto check = [&](const std::vector<std::string>& channels, const std::vector<float>& v) {
    write_map(file.path, channels, 2, v);
    const io::SlopeImage image = io::read_slope_map(file.path);
    REQUIRE(image.width == 2);
    REQUIRE(image.height == 2);
    for (std::size_t i = 0; i < slopes.size(); ++i) {
      CHECK(image.slopes[i].x == Approx(slopes[i].x).margin(1e-6));
      CHECK(image.slopes[i].y == Approx(slopes[i].y).margin(1e-6));
    }
  };
  check({"R", "G", "B"}, normals);
  check({"X", "Y", "Z"}, normals);
  check({"R", "G", "B"}, shifted);
  check({"slope_x", "slope_y"}, stored);
  check({"x", "y"}, stored);

  const auto without_z = [](const std::vector<float>& values) {
    std::vector<float> rest;
    for (std::size_t i = 0; i < values.size(); ++i)
      if (i % 3 != 2) rest.push_back(values[i]);
    return rest;
  };
  check({"X", "Y"}, without_z(normals));
  check({"R", "G"}, without_z(normals));
  check({"R", "G"}, without_z(shifted));
}

TEST_CASE("a folder is no map") {
  CHECK_THROWS_WITH(io::read_slope_map("."), contains(".: it is not a file"));
}

TEST_CASE("maps that cannot be read are refused with the file and the reason") {
  const TemporaryFile file;
  const auto refused = [&](const std::string& why) {
    CHECK_THROWS_WITH(io::read_slope_map(file.path),
                      contains("vndf-map-image-test") && contains(why));
    CHECK_THROWS_AS(io::read_slope_map(file.path), io::MapImageError);
  };
  refused("no such file");
  std::ofstream(file.path) << "not an image";
  refused("it is none of the images that are read; give an EXR, PNG or TIFF file");
  write_map(file.path, {"Y"}, 1, {1});
  refused("its channels are Y; give channels R, G, B");
  write_map(file.path, {"R", "G", "B"}, 2, {0, 0, 1, 0.6f, 0, -0.8f});
  refused("column 1 of row 0 holds a normal with z = -0.8");
  write_map(file.path, {"R", "G", "B"}, 1, {0, 0, 1, -2, 0, 1});
  refused("column 0 of row 1 holds a normal of length 2.2");
  write_map(file.path, {"x", "y"}, 1, {std::numeric_limits<float>::infinity(), 0});
  refused("not finite");
  write_map(file.path, {"x", "y"}, 16385, std::vector<float>(2 * 16385));
  refused("16385 x 1 texels");
}

TEST_CASE("PNG files of 8 and 16 bits are read as shifted normals") {
  const std::string texels8{
      "\xc0\x80\xe0"
      "\x40\x80\xe0",
      6};
  check_read(png_file({2, 1}, {texels8}), {n8(192, 128, 224), n8(64, 128, 224)},
             "8-bit PNG, normals n = 2 v - 1");
  const std::string with_alpha{
      "\xc0\x80\xe0\x00"
      "\x40\x80\xe0\x07",
      8};
  check_read(png_file({2, 1, 8, 6}, {with_alpha}), {n8(192, 128, 224), n8(64, 128, 224)},
             "8-bit PNG");
  check_read(png_file({1, 2, 16}, {wide({40000, 30000, 60000}), wide({32768, 32767, 65535})}),
             {n16(40000, 30000, 60000), n16(32768, 32767, 65535)},
             "16-bit PNG, normals n = 2 v - 1");
}

TEST_CASE("a gamma in a PNG file does not change its normals") {
  const std::string texels{"\xc0\x80\xe0", 3};
  check_read(png_file({1, 1}, {texels}, png_chunk("gAMA", number_bytes(45455, 4))),
             {n8(192, 128, 224)}, "8-bit PNG");
}

TEST_CASE("TIFF files of integers and floats, of either order of bytes, are read") {
  const std::string texels8{
      "\xc0\x80\xe0"
      "\x40\x80\xe0",
      6};
  const std::vector<Vec2<double>> slopes8{n8(192, 128, 224), n8(64, 128, 224)};
  check_read(tiff_file(rgb_fields(2, 1, 8), texels8), slopes8, "8-bit TIFF, normals n = 2 v - 1");
  constexpr std::uint32_t kDeflate = 8;
  check_read(tiff_file(rgb_fields(2, 1, 8, 3, 1, kDeflate), deflated(texels8)), slopes8, "TIFF");
  for (const bool big : {false, true}) {
    const std::vector<std::uint32_t> numbers{40000, 30000, 60000, 7, 32768, 32767, 65535, 8};
    check_read(tiff_file(rgb_fields(2, 1, 16, 4), wide(numbers, 2, big), big),
               {n16(40000, 30000, 60000), n16(32768, 32767, 65535)},
               "16-bit TIFF, normals n = 2 v - 1");
    const std::vector<std::uint32_t> floats{std::bit_cast<std::uint32_t>(-0.6f), 0,
                                            std::bit_cast<std::uint32_t>(0.8f)};
    constexpr std::uint32_t kFloat = 3;
    check_read(tiff_file(rgb_fields(1, 1, 32, 3, kFloat), wide(floats, 4, big), big), {{0.75, 0}},
               "float TIFF, normals n = v");
  }
}

TEST_CASE("the encoding is that of the option, and whole numbers have but one") {
  const TemporaryFile file;
  write_map(file.path, {"R", "G", "B"}, 1, {0.2f, 0.1f, 0.9f});
  using io::NormalEncoding;
  CHECK(io::read_slope_map(file.path).slopes[0].x == Approx(0.6 / 0.8));
  CHECK(io::read_slope_map(file.path, NormalEncoding::plain).slopes[0].x == Approx(-0.2 / 0.9));
  CHECK(io::read_slope_map(file.path).content == "EXR, normals n = 2 v - 1");
  file.write(png_file({1, 1}, {std::string("\x80\x80\xff", 3)}));
  CHECK_NOTHROW(io::read_slope_map(file.path, NormalEncoding::shifted));
  CHECK_THROWS_WITH(io::read_slope_map(file.path, NormalEncoding::plain),
                    contains("8-bit PNG, whose numbers cannot be negative"));
}

TEST_CASE("PNG and TIFF files that are no normal maps are refused with the rule and a remedy") {
  check_refused(png_file({1, 1, 8, 0}, {"a"}), "no colours R, G and B");
  check_refused(png_file({1, 1, 1, 3}, {"a"}, png_chunk("PLTE", "abcdef")),
                "no colours R, G and B");
  check_refused(png_file({20000, 1}, {""}), "libpng finds it broken");
  check_refused(png_file({16384, 16384}, {""}),
                "16384 x 16384 texels, which is more than a file of");
  check_refused(png_file({2, 2}, {"abcdef"}), "libpng finds it broken");
  std::string changed = png_file({1, 1}, {"abc"});
  changed[changed.size() - 20] ^= 1;
  check_refused(changed, "libpng finds it broken");
  // A text that claims to be of 2 GiB.
  std::string long_text = png_chunk("zTXt", "a text");
  long_text.replace(0, 4, "\x7f\xff\xff\xff");
  check_refused(png_file({1, 1}, {"abc"}, long_text), "libpng finds it broken");
  check_refused(png_file({1, 1}, {std::string(3, '\0')}), "column 0 of row 0 holds a normal of");

  check_refused(tiff_file(rgb_fields(1, 1, 8, 2), "ab"), "no colours R, G and B");
  check_refused(tiff_file(rgb_fields(1, 1, 64, 3, 3), std::string(24, 'a')),
                "no colours R, G and B");
  check_refused(tiff_file(rgb_fields(16385, 1, 8), "abc"), "16385 x 1 texels");
  check_refused(tiff_file(rgb_fields(16384, 16384, 8), "abc"), "which is more than a file of");
  check_refused(tiff_file(rgb_fields(1, 2, 8, 3, 1, 8), deflated("\x80\x80\xff")),
                "libtiff finds it broken");
  constexpr std::uint32_t kJpeg = 7;
  check_refused(tiff_file(rgb_fields(1, 1, 8, 3, 1, kJpeg), "abc"), "its compression is not read");
  check_refused("II", "none of the images");
  check_refused(std::string("II*\0\xff\xff\xff\xff", 8), "libtiff finds it broken");
}

TEST_CASE(
    "an EXR header that declares more than its file can hold is refused before it is opened") {
  const auto header = [](const Imf::Header& h) {
    const TemporaryFile file;
    { Imf::OutputFile opened(file.path.c_str(), h, 0); }
    return file.bytes();
  };
  Imf::Header many_channels(4, 4);
  for (int c = 0; c < 65; ++c)
    many_channels.channels().insert(std::string("c").append(std::to_string(c)),
                                    Imf::Channel(Imf::HALF));
  check_refused(header(many_channels), "it has 65 channels");

  const TemporaryFile file;
  write_map(file.path, {"R", "G", "B"}, 2, {0, 0, 1, 0.6f, 0, 0.8f});
  const std::string whole = file.bytes();
  const auto with_window = [&](std::uint32_t right) {
    std::string bytes = whole;
    const std::size_t window = bytes.find("dataWindow") + 11 + 6 + 4;
    return bytes.replace(window + 8, 4, number_bytes(right, 4, false));
  };
  check_refused(with_window(0x7fffffff), "2147483645 x 1 texels");
  check_refused(with_window(0xffffffff), "-3 x 1 texels");

  const auto tiles = [&](std::uint32_t side) {
    Imf::Header tiled(16384, 16384);
    tiled.setTileDescription({64, 64, Imf::ONE_LEVEL});
    for (const char* name : {"R", "G", "B"}) tiled.channels().insert(name, Imf::Channel(Imf::HALF));
    const TemporaryFile map;
    { Imf::TiledOutputFile opened(map.path.c_str(), tiled, 0); }
    std::string bytes = map.bytes();
    const std::size_t place = bytes.find("tiledesc") + 9 + 4;
    return bytes.replace(place, 8, number_bytes(side, 4, false) + number_bytes(side, 4, false));
  };
  check_refused(tiles(1), "more tiles than a file of its size has room for");
  check_refused(tiles(0), "its tiles have 0 x 0 texels");
  check_refused(tiles(16384), "its tiles have 16384 x 16384 texels");
}

TEST_CASE("a damaged PNG or TIFF file is refused or read, and never more") {
  const std::string texels{
      "\xc0\x80\xe0"
      "\x40\x80\xe0",
      6};
  const TemporaryFile file;
  const auto try_bytes = [&](const std::string& bytes) {
    file.write(bytes);
    try {
      io::read_slope_map(file.path);
    } catch (const io::MapImageError&) {
    }
  };
  for (const std::string& whole :
       {png_file({2, 1}, {texels}), tiff_file(rgb_fields(2, 1, 8), texels),
        tiff_file(rgb_fields(2, 1, 8, 3, 1, 8), deflated(texels), true)})
    for (std::size_t i = 0; i < whole.size(); ++i) {
      CHECK_NOTHROW(try_bytes(whole.substr(0, i)));
      for (const int flip : {0x01, 0x80, 0xff}) {
        std::string changed = whole;
        changed[i] = static_cast<char>(changed[i] ^ flip);
        CHECK_NOTHROW(try_bytes(changed));
      }
    }
}

TEST_CASE("a damaged map is refused or read, and never more") {
  const TemporaryFile file;
  write_map(file.path, {"R", "G", "B"}, 2, {0, 0, 1, 0.6f, 0, 0.8f, 0, -0.6f, 0.8f, 0, 0, 1});
  std::ifstream stream(file.path, std::ios::binary);
  const std::string whole{std::istreambuf_iterator<char>(stream), {}};
  const auto try_bytes = [&](const std::string& bytes) {
    std::ofstream(file.path, std::ios::binary) << bytes;
    try {
      io::read_slope_map(file.path);
    } catch (const io::MapImageError&) {
    }
  };
  for (std::size_t i = 0; i < whole.size(); ++i) {
    CHECK_NOTHROW(try_bytes(whole.substr(0, i)));
    std::string changed = whole;
    changed[i] = static_cast<char>(changed[i] ^ 0xff);
    CHECK_NOTHROW(try_bytes(changed));
  }
}
