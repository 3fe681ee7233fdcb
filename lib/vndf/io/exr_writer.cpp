// Writing EXR in memory. EXR has no float64 pixels: float64 arrays are two channels of
// 32-bit words, which keeps every bit.
#include "vndf/io/exr_writer.h"

#include <ImfChannelList.h>
#include <ImfDoubleAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIntAttribute.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfStringAttribute.h>

#include <bit>
#include <cstdint>
#include <exception>

#include "vndf/io/exr_memory_stream.h"
#include "vndf/io/format_error.h"

namespace vndf::io {
namespace {

constexpr char kValue[] = "Y", kHigh[] = "high", kLow[] = "low";
constexpr int kNoThreads = 0;

// A float64 array as two arrays of 32-bit words.
struct Words {
  std::vector<std::uint32_t> high, low;
};

Words words_of(const std::vector<double>& values) {
  Words words;
  words.high.reserve(values.size());
  words.low.reserve(values.size());
  for (const double value : values) {
    const auto bits = std::bit_cast<std::uint64_t>(value);
    words.high.push_back(static_cast<std::uint32_t>(bits >> 32));
    words.low.push_back(static_cast<std::uint32_t>(bits));
  }
  return words;
}

/// A channel kept in `values`, rows of `columns`. OpenEXR reads through the pointer or writes, as
/// the file is written or read, and takes no const.
template <class T>
Imf::Slice slice(Imf::PixelType type, const std::vector<T>& values, std::size_t columns) {
  char* base = reinterpret_cast<char*>(const_cast<T*>(values.data()));
  return {type, base, sizeof(T), sizeof(T) * columns};
}

Imf::FrameBuffer frame_of(const std::vector<float>& values, std::size_t columns) {
  Imf::FrameBuffer frame;
  frame.insert(kValue, slice(Imf::FLOAT, values, columns));
  return frame;
}

Imf::FrameBuffer frame_of(const Words& words, std::size_t columns) {
  Imf::FrameBuffer frame;
  frame.insert(kHigh, slice(Imf::UINT, words.high, columns));
  frame.insert(kLow, slice(Imf::UINT, words.low, columns));
  return frame;
}

void insert(Imf::Header& header, const std::string& name, int value) {
  header.insert(name, Imf::IntAttribute(value));
}
void insert(Imf::Header& header, const std::string& name, double value) {
  header.insert(name, Imf::DoubleAttribute(value));
}
void insert(Imf::Header& header, const std::string& name, const std::string& value) {
  header.insert(name, Imf::StringAttribute(value));
}
void insert(Imf::Header&, const std::string& name, NotUsed) {
  throw FormatError("the attribute '" + name + "' has no value", "give it one");
}

Imath::Box2i window_of(const std::string& name, const Array& array) {
  if (array.shape.size() != 2)
    throw FormatError("the array '" + name + "' has not two axes", "give it rows and columns");
  return {{0, 0}, {static_cast<int>(array.shape[1]) - 1, static_cast<int>(array.shape[0]) - 1}};
}

/// What programs show of every part, for EXR demands that all parts share it: the tables.
Imath::Box2i display_of(const StoredTables& stored) {
  Imath::Box2i display{{0, 0}, {0, 0}};
  for (const char* name : {"marginal", "conditional"})
    if (const auto found = stored.arrays.find(name); found != stored.arrays.end())
      display.extendBy(window_of(found->first, found->second));
  return display;
}

Imf::Header header_of(const std::string& name, const Array& array, const Imath::Box2i& display) {
  Imf::Header header(display, window_of(name, array));
  header.compression() = Imf::ZIP_COMPRESSION;
  header.setName(name);
  header.setType(Imf::SCANLINEIMAGE);
  if (std::holds_alternative<std::vector<double>>(array.values)) {
    header.channels().insert(kHigh, Imf::Channel(Imf::UINT));
    header.channels().insert(kLow, Imf::Channel(Imf::UINT));
  } else {
    header.channels().insert(kValue, Imf::Channel(Imf::FLOAT));
  }
  return header;
}

std::vector<Imf::Header> headers_of(const StoredTables& stored) {
  const Imath::Box2i display = display_of(stored);
  std::vector<Imf::Header> headers;
  for (const auto& [name, array] : stored.arrays)
    headers.push_back(header_of(name, array, display));
  for (const auto& [name, attribute] : stored.attributes)
    std::visit([&, &n = name](const auto& value) { insert(headers.at(0), n, value); }, attribute);
  return headers;
}

template <class Pixels>
void write_pixels(Imf::MultiPartOutputFile& file, int part, const Array& array,
                  const Pixels& pixels) {
  Imf::OutputPart out(file, part);
  out.setFrameBuffer(frame_of(pixels, array.shape[1]));
  out.writePixels(static_cast<int>(array.shape[0]));
}

void write_array(Imf::MultiPartOutputFile& file, int part, const Array& array) {
  if (const auto* f = std::get_if<std::vector<float>>(&array.values))
    write_pixels(file, part, array, *f);
  if (const auto* d = std::get_if<std::vector<double>>(&array.values))
    write_pixels(file, part, array, words_of(*d));
}

void write_file(Imf::OStream& stream, const StoredTables& stored) {
  const std::vector<Imf::Header> headers = headers_of(stored);
  Imf::MultiPartOutputFile file(stream, headers.data(), static_cast<int>(headers.size()), false,
                                kNoThreads);
  int part = 0;
  for (const auto& [name, array] : stored.arrays) write_array(file, part++, array);
}

}  // namespace

std::string write_exr(const StoredTables& stored) try {
  ExrMemoryOutput stream;
  write_file(stream, stored);
  return stream.take();
} catch (const FormatError&) {
  throw;
} catch (const std::exception& error) {
  throw FormatError(std::string("OpenEXR cannot write it: ") + error.what(),
                    "make the tables again");
}

}  // namespace vndf::io
