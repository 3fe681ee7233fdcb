// Writing and reading EXR in memory. EXR has no float64 pixels: float64 arrays are two channels of
// 32-bit words, which keeps every bit.
#include "vndf/io/exr_table_file.h"

#include <ImfChannelList.h>
#include <ImfDoubleAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputPart.h>
#include <ImfIntAttribute.h>
#include <ImfMultiPartInputFile.h>
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

std::vector<double> doubles_of(const Words& words) {
  std::vector<double> values;
  values.reserve(words.high.size());
  for (std::size_t i = 0; i < words.high.size(); ++i)
    values.push_back(std::bit_cast<double>(std::uint64_t{words.high[i]} << 32 | words.low[i]));
  return values;
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

// Writing.

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

Imf::Header header_of(const std::string& name, const Array& array) {
  if (array.shape.size() != 2)
    throw FormatError("the array '" + name + "' has not two axes", "give it rows and columns");
  Imf::Header header(static_cast<int>(array.shape[1]), static_cast<int>(array.shape[0]));
  // All parts of a file share one display window; it has no meaning here.
  header.displayWindow() = {{0, 0}, {0, 0}};
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
  std::vector<Imf::Header> headers;
  for (const auto& [name, array] : stored.arrays) headers.push_back(header_of(name, array));
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

// Reading.

Attribute read_attribute(const Imf::Attribute& attribute) {
  if (const auto* i = dynamic_cast<const Imf::IntAttribute*>(&attribute)) return i->value();
  if (const auto* d = dynamic_cast<const Imf::DoubleAttribute*>(&attribute)) return d->value();
  if (const auto* s = dynamic_cast<const Imf::StringAttribute*>(&attribute)) return s->value();
  return NotUsed{};
}

/// Rows and columns of a part whose pixels start at (0, 0); nothing of any other.
std::vector<std::size_t> shape_of(const Imf::Header& header) {
  const Imath::Box2i& window = header.dataWindow();
  if (window.min != Imath::V2i(0, 0) || window.max.x < 0 || window.max.y < 0) return {};
  return {static_cast<std::size_t>(window.max.y) + 1, static_cast<std::size_t>(window.max.x) + 1};
}

/// True if `names` are the channels of the part, all of one type and full resolution.
bool has_channels(const Imf::Header& header, const std::vector<std::string>& names,
                  Imf::PixelType type) {
  std::size_t count = 0;
  for (auto c = header.channels().begin(); c != header.channels().end(); ++c) ++count;
  if (count != names.size()) return false;
  for (const std::string& name : names) {
    const Imf::Channel* c = header.channels().findChannel(name);
    if (c == nullptr || c->type != type || c->xSampling != 1 || c->ySampling != 1) return false;
  }
  return true;
}

template <class Pixels>
void read_pixels(Imf::MultiPartInputFile& file, int part, const Array& array, Pixels& pixels) {
  Imf::InputPart in(file, part);
  in.setFrameBuffer(frame_of(pixels, array.shape[1]));
  in.readPixels(0, static_cast<int>(array.shape[0]) - 1);
}

Array read_array(Imf::MultiPartInputFile& file, int part) {
  const Imf::Header& header = file.header(part);
  Array array{shape_of(header), NotUsed{}};
  const bool scanlines = !header.hasType() || header.type() == Imf::SCANLINEIMAGE;
  if (!scanlines || !may_read(array.shape)) return array;
  const std::size_t count = array.shape[0] * array.shape[1];
  if (has_channels(header, {kValue}, Imf::FLOAT)) {
    std::vector<float> values(count);
    read_pixels(file, part, array, values);
    array.values = std::move(values);
  } else if (has_channels(header, {kHigh, kLow}, Imf::UINT)) {
    Words words{std::vector<std::uint32_t>(count), std::vector<std::uint32_t>(count)};
    read_pixels(file, part, array, words);
    array.values = doubles_of(words);
  }
  return array;
}

StoredTables read_file(Imf::MultiPartInputFile& file) {
  StoredTables stored;
  const Imf::Header& first = file.header(0);
  for (auto a = first.begin(); a != first.end(); ++a)
    stored.attributes[a.name()] = read_attribute(a.attribute());
  for (int part = 0; part < file.parts(); ++part)
    if (file.header(part).hasName())
      stored.arrays[file.header(part).name()] = read_array(file, part);
  return stored;
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

StoredTables read_exr(std::string_view bytes) try {
  ExrMemoryInput stream(bytes);
  Imf::MultiPartInputFile file(stream, kNoThreads, false);
  return read_file(file);
} catch (const std::exception& error) {
  throw FormatError(std::string("OpenEXR cannot read it: ") + error.what(),
                    "build the table again");
}

}  // namespace vndf::io
