// Writing images of named channels.
#include "vndf/io/exr_image.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>

#include <exception>

#include "vndf/io/exr_memory_stream.h"
#include "vndf/io/format_error.h"

namespace vndf::io {
namespace {

constexpr int kNoThreads = 0;

void check(const ExrImage& image) {
  if (image.channels.empty() || image.width == 0 || image.height == 0)
    throw FormatError("the image is empty", "give it a size and a channel");
  for (const auto& [name, values] : image.channels)
    if (values.size() != image.width * image.height)
      throw FormatError(
          "the channel '" + name + "' has " + std::to_string(values.size()) + " values",
          "give it " + std::to_string(image.width * image.height));
}

Imf::Header header_of(const ExrImage& image) {
  Imf::Header header(static_cast<int>(image.width), static_cast<int>(image.height));
  header.compression() = Imf::ZIP_COMPRESSION;
  for (const auto& [name, values] : image.channels)
    header.channels().insert(name, Imf::Channel(Imf::FLOAT));
  for (const auto& [name, value] : image.attributes)
    header.insert(name, Imf::StringAttribute(value));
  return header;
}

Imf::FrameBuffer frame_of(const ExrImage& image) {
  Imf::FrameBuffer frame;
  for (const auto& [name, values] : image.channels)
    frame.insert(name, Imf::Slice::Make(Imf::FLOAT, values.data(), {0, 0},
                                        static_cast<std::int64_t>(image.width),
                                        static_cast<std::int64_t>(image.height)));
  return frame;
}

}  // namespace

std::string write_exr_image(const ExrImage& image) try {
  check(image);
  ExrMemoryOutput stream;
  {
    Imf::OutputFile file(stream, header_of(image), kNoThreads);  // is whole once it is destroyed
    file.setFrameBuffer(frame_of(image));
    file.writePixels(static_cast<int>(image.height));
  }
  return stream.take();
} catch (const FormatError&) {
  throw;
} catch (const std::exception& error) {
  throw FormatError(std::string("OpenEXR cannot write it: ") + error.what(), "check the names");
}

}  // namespace vndf::io
