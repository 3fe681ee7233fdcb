// Images of radiance in EXR files: what is read, and every reason to refuse one. The reading of
// channels is shared with maps, whose test breaks the format in more ways.
#include "vndf/io/radiance_image.h"

#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "support/catch.h"
#include "vndf/io/exr_image.h"

using namespace vndf;
using vndf::test::contains;

namespace {

using Channels = std::map<std::string, std::vector<float>>;

struct TemporaryFile {
  std::filesystem::path path =
      std::filesystem::temp_directory_path() / "vndf-radiance-image-test.exr";
  ~TemporaryFile() { std::filesystem::remove(path); }
};

/// The bytes of an image of two columns.
std::string exr_of(const Channels& channels) {
  return io::write_exr_image({2, channels.begin()->second.size() / 2, channels});
}

io::RadianceImage read(const std::string& bytes) {
  const TemporaryFile file;
  std::ofstream(file.path, std::ios::binary) << bytes;
  return io::read_radiance_image(file.path);
}

void check_refused(const std::string& bytes, const std::string& why) {
  CHECK_THROWS_AS(read(bytes), io::RadianceImageError);
  CHECK_THROWS_WITH(read(bytes), contains("vndf-radiance-image-test.exr: " + why));
}

Channels with_blue(float value) {
  return {{"R", {0, 1, 2, 3}}, {"G", {4, 5, 6, 7}}, {"B", {8, 9, value, 11}}};
}

}  // namespace

TEST_CASE("R, G and B are read row by row from the top, and other channels are ignored") {
  Channels channels = with_blue(10);
  channels["A"] = {-1, -1, -1, -1};
  const io::RadianceImage image = read(exr_of(channels));
  CHECK(image.width == 2);
  CHECK(image.height == 2);
  CHECK(image.values == std::vector<float>{0, 4, 8, 1, 5, 9, 2, 6, 10, 3, 7, 11});
}

TEST_CASE("Y is read as grey") {
  CHECK(read(exr_of({{"Y", {0, 0.5f}}})).values == std::vector<float>{0, 0, 0, 0.5f, 0.5f, 0.5f});
}

TEST_CASE("what is not radiance is refused with its place") {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const std::string texel = "the texel in column 0 of row 1 holds ";
  check_refused(exr_of(with_blue(-1e-6f)), texel + "a negative value; ");
  check_refused(exr_of(with_blue(kInfinity)), texel + "a value that is not finite; ");
  check_refused(exr_of(with_blue(-kInfinity)), texel + "a negative value; ");
  check_refused(exr_of(with_blue(std::numeric_limits<float>::quiet_NaN())),
                texel + "a value that is not finite; ");
}

TEST_CASE("an image without light is refused, and -0 is no light") {
  check_refused(exr_of({{"Y", {0, -0.0f}}}), "it is black everywhere; give an image with light");
}

TEST_CASE("files that are no image of radiance are refused with the rule and a remedy") {
  CHECK_THROWS_WITH(io::read_radiance_image("no-such.exr"),
                    "no-such.exr: there is no such file; check the path");
  CHECK_THROWS_WITH(io::read_radiance_image("."), contains(".: it is not a file; "));
  check_refused("", "it is not an EXR file; give one, or convert it");
  check_refused("#?RADIANCE\n", "it is not an EXR file; ");
  check_refused(exr_of({{"x", {1, 1}}, {"y", {1, 1}}}),
                "its channels are x, y; give the channels R, G and B of linear colour, or Y of");
}

TEST_CASE("a damaged image of radiance is refused or read, and never more") {
  const std::string whole = exr_of(with_blue(10));
  const auto try_bytes = [](const std::string& bytes) {
    try {
      read(bytes);
    } catch (const io::RadianceImageError&) {
    }
  };
  for (std::size_t i = 0; i < whole.size(); ++i) {
    CHECK_THROWS_AS(read(whole.substr(0, i)), io::RadianceImageError);
    std::string changed = whole;
    changed[i] = static_cast<char>(changed[i] ^ 0xff);
    CHECK_NOTHROW(try_bytes(changed));
  }
}
