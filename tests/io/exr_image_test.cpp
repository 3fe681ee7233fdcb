// Images of named channels, read back by OpenEXR itself.
#include "vndf/io/exr_image.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfStringAttribute.h>

#include <limits>

#include "support/catch.h"
#include "support/exr_memory_input.h"
#include "vndf/io/format_error.h"

using namespace vndf::io;
using namespace vndf::test;

namespace {

std::vector<float> read_channel(Imf::InputFile& file, const std::string& name, std::size_t count,
                                int width) {
  std::vector<float> values(count);
  Imf::FrameBuffer frame;
  frame.insert(name, Imf::Slice::Make(Imf::FLOAT, values.data(), {0, 0}, width, 2));
  file.setFrameBuffer(frame);
  file.readPixels(0, 1);
  return values;
}

}  // namespace

TEST_CASE("an image reads back with its size, channels, values and attributes") {
  const ExrImage image{
      3,
      2,
      {{"theta_30.exact", {1, 2, 3, 4, 5, 6}}, {"theta_30.sampled", {0, 0, 1e-30f, 1e30f, -1, 7}}},
      {{"axes", "slope x"}}};
  const std::string bytes = write_exr_image(image);
  ExrMemoryInput stream(bytes);
  Imf::InputFile file(stream, 0);
  CHECK(file.header().dataWindow() == Imath::Box2i({0, 0}, {2, 1}));
  CHECK(file.header().displayWindow() == file.header().dataWindow());
  CHECK(file.header().typedAttribute<Imf::StringAttribute>("axes").value() == "slope x");
  for (const auto& [name, values] : image.channels) CHECK(read_channel(file, name, 6, 3) == values);
  CHECK(write_exr_image(image) == bytes);
}

TEST_CASE("an image without channels or with a channel of another size is refused") {
  CHECK_THROWS_AS(write_exr_image({3, 2, {}, {}}), FormatError);
  CHECK_THROWS_AS(write_exr_image({0, 0, {{"a", {}}}, {}}), FormatError);
  CHECK_THROWS_WITH(write_exr_image({3, 2, {{"a", {1, 2, 3}}}, {}}),
                    contains("channel 'a' has 3 values") && contains("give it 6"));
}
