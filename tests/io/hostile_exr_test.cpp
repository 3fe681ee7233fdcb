// EXR files that somebody wrote to do harm, and others that are unusual and right. The reader is
// our own, so OpenEXR is what it is tested against.
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfStringAttribute.h>
#include <zlib.h>

#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include "io/hostile_file.h"
#include "support/catch.h"
#include "support/exr_memory_input.h"
#include "vndf/io/exr_memory_stream.h"
#include "vndf/io/exr_reader.h"
#include "vndf/io/exr_writer.h"
#include "vndf/io/format_error.h"
#include "vndf/io/stored_tables.h"

namespace {

using namespace vndf;
using namespace vndf::io;
using namespace vndf::test;

const StoredTables& honest() {
  static const StoredTables stored = to_stored(small_table_file());
  return stored;
}

std::string message_of(const std::string& bytes) {
  return test::message_of(bytes, read_exr);
}

void check_refused(const std::string& bytes, const std::string& part) {
  CHECK_THAT(message_of(bytes), Catch::Contains(part));
}

/// Place of the value of an attribute in the header of the part with that number. Parts are in the
/// order of their names, and each has every one of the attributes that are asked for.
std::size_t value_of(const std::string& bytes, const std::string& name, const std::string& type,
                     std::size_t part = 0) {
  const std::string head = name + '\0' + type + '\0';
  std::size_t at = bytes.find(head);
  while (part-- > 0) at = bytes.find(head, at + 1);
  REQUIRE(at != std::string::npos);
  return at + head.size() + 4;
}

void put_number(std::string& bytes, std::size_t at, std::int32_t number) {
  std::memcpy(bytes.data() + at, &number, sizeof number);
}

/// Place of the table of chunks of the first part. It follows the last attribute of the last part
/// and two zeros, which end the header and the list of headers.
std::size_t first_table(const std::string& bytes) {
  constexpr std::string_view kLast = "scanlineimage";
  return bytes.rfind(kLast) + kLast.size() + 2;
}

using Change = std::function<void(std::vector<Imf::Header>&)>;
/// An honest file that OpenEXR wrote again with changed headers, and with zeros in added parts.
std::string rewritten(const Change& change) {
  const std::string good = write_exr(honest());
  ExrMemoryInput input(good);
  Imf::MultiPartInputFile in(input);
  std::vector<Imf::Header> headers;
  for (int k = 0; k < in.parts(); ++k) headers.push_back(in.header(k));
  change(headers);
  ExrMemoryOutput output;
  {
    Imf::MultiPartOutputFile out(output, headers.data(), static_cast<int>(headers.size()));
    for (int k = 0; k < static_cast<int>(headers.size()); ++k) {
      Imf::OutputPart to(out, k);
      const Imath::Box2i window = headers[static_cast<std::size_t>(k)].dataWindow();
      const auto columns = static_cast<std::size_t>(window.max.x) + 1;
      const auto rows = static_cast<std::size_t>(window.max.y) + 1;
      std::map<std::string, std::vector<float>> pixels;
      Imf::FrameBuffer frame;
      const Imf::ChannelList& channels = headers[static_cast<std::size_t>(k)].channels();
      for (auto c = channels.begin(); c != channels.end(); ++c) {
        std::vector<float>& values = pixels[c.name()];
        values.resize(rows * columns);
        frame.insert(c.name(), Imf::Slice(c.channel().type, reinterpret_cast<char*>(values.data()),
                                          sizeof(float), sizeof(float) * columns));
      }
      if (k < in.parts()) {
        Imf::InputPart from(in, k);
        from.setFrameBuffer(frame);
        from.readPixels(0, window.max.y);
      }
      to.setFrameBuffer(frame);
      for (int y = 0; y <= window.max.y; ++y) to.writePixels(1);
    }
  }
  return output.take();
}

}  // namespace

TEST_CASE("other programs show the tables of an EXR file in full and read their values") {
  const std::string bytes = write_exr(honest());
  ExrMemoryInput stream(bytes);
  Imf::MultiPartInputFile file(stream);
  for (int k = 0; k < file.parts(); ++k)
    CHECK(file.header(k).displayWindow() ==
          Imath::Box2i({0, 0}, {int{kSmallColumns} - 1, int{kSmallRows} - 1}));
  const int part = [&] {
    for (int k = 0; k < file.parts(); ++k)
      if (file.header(k).name() == "marginal") return k;
    return -1;
  }();
  CHECK(file.header(part).dataWindow() == file.header(part).displayWindow());
  std::vector<float> values(kSmallRows * kSmallColumns);
  Imf::FrameBuffer frame;
  frame.insert("Y", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data()), sizeof(float),
                               sizeof(float) * kSmallColumns));
  Imf::InputPart in(file, part);
  in.setFrameBuffer(frame);
  in.readPixels(0, kSmallRows - 1);
  CHECK(values == small_rows());
}

TEST_CASE("an EXR file is read whatever the order of its lines and its additions are") {
  CHECK(message_of(rewritten([](auto&) {})) == "the same");
  CHECK(message_of(rewritten([](auto& headers) { headers[0].lineOrder() = Imf::DECREASING_Y; })) ==
        "the same");
  CHECK(message_of(rewritten([](std::vector<Imf::Header>& headers) {
          headers[0].insert("added", Imf::StringAttribute("an attribute"));
          Imf::Header added = headers[0];
          added.setName("added");
          added.compression() = Imf::PIZ_COMPRESSION;
          headers.push_back(added);
        })) == "the same");
}

TEST_CASE("other compressions, channels and parts are refused in an EXR file") {
  check_refused(rewritten([](auto& headers) { headers[0].compression() = Imf::PIZ_COMPRESSION; }),
                "'conditional': it is not compressed by ZIP");
  check_refused(rewritten([](auto& headers) { headers[0].compression() = Imf::ZIPS_COMPRESSION; }),
                "'conditional': it is not compressed by ZIP");
  check_refused(
      rewritten([](auto& headers) { headers[0].channels().insert("Z", Imf::Channel(Imf::FLOAT)); }),
      "the values of the array 'conditional' are not float32");
  std::string bytes = write_exr(honest());
  bytes[bytes.find("scanlineimage")] = 'x';
  check_refused(bytes, "the values of the array 'conditional' are not float32");
  bytes = write_exr(honest());
  bytes[5] = 0;
  check_refused(bytes, "not an EXR file of several scan line parts");
}

TEST_CASE("windows and chunks that an EXR file only declares take no memory") {
  const std::string good = write_exr(honest());
  const std::size_t window = value_of(good, "dataWindow", "box2i");
  const auto with_window = [&](std::int32_t left, std::int32_t right, std::int32_t bottom) {
    std::string bytes = good;
    put_number(bytes, window, left);
    put_number(bytes, window + 8, right);
    put_number(bytes, window + 12, bottom);
    return bytes;
  };
  check_refused(with_window(0, 8191, 8191),
                "'conditional': its arrays are larger than a file of its size can hold");
  check_refused(with_window(0, 511, 8191),
                "'conditional': a part of the EXR file has not one chunk");
  check_refused(with_window(0, 0x7fffffff, 0x7fffffff), "'conditional' has the shape");
  check_refused(with_window(0, -2, 15), "'conditional' has the shape a single value");
  check_refused(with_window(-0x7fffffff, 0x7fffffff, 15), "'conditional' has the shape");
  check_refused(with_window(-4, kSmallColumns - 1, kSmallRows - 1), "'conditional' has the shape");
  for (const std::int32_t count : {-1, 0x7fffffff, 0x100000}) {
    std::string bytes = good;
    put_number(bytes, value_of(bytes, "chunkCount", "int"), count);
    check_refused(bytes, "a part of it ends before all was said");
  }
}

TEST_CASE("attributes and parts that are there twice are refused in an EXR file") {
  const auto renamed = [](const std::string& from, const std::string& to) {
    std::string bytes = write_exr(honest());
    REQUIRE(from.size() == to.size());
    return bytes.replace(bytes.find(from), from.size(), to);
  };
  check_refused(renamed("certificate_marginal_lower_tail_ratio_1e-5",
                        "certificate_marginal_lower_tail_ratio_1e-4"),
                "'certificate_marginal_lower_tail_ratio_1e-4' is there twice");
  check_refused(renamed("log_ndf_segments", "conditional_rows"),
                "'conditional_rows' is there twice");
}

TEST_CASE("chunks of an EXR file that are not where they should be are refused") {
  const std::string good = write_exr(honest());
  const std::size_t table = first_table(good);
  std::uint64_t first;
  std::memcpy(&first, good.data() + table, sizeof first);
  std::int32_t head[3];
  std::memcpy(head, good.data() + first, sizeof head);
  REQUIRE((head[0] == 0 && head[1] == 0));  // part and line
  const auto pointing = [&](std::uint64_t place) {
    std::string bytes = good;
    std::memcpy(bytes.data() + table, &place, sizeof place);
    return bytes;
  };
  CHECK(message_of(pointing(first)) == "the same");
  check_refused(pointing(first + 4), "'conditional': lines of the EXR file are not where");
  // `marginal` is the seventh part, each of those before has one chunk, and its values are the
  // same.
  constexpr std::size_t kMarginal = 6;
  std::uint64_t other;
  std::memcpy(&other, good.data() + table + kMarginal * sizeof other, sizeof other);
  REQUIRE(good[other] == kMarginal);
  check_refused(pointing(other), "'conditional': lines of the EXR file are not where");
  check_refused(pointing(good.size() - 4), "'conditional': a part of it ends");
  check_refused(pointing(~std::uint64_t{0}), "'conditional': it points outside of itself");

  const auto deflated = [&](std::size_t count) {
    std::vector<Bytef> zeros(count), chunk(compressBound(count));
    uLongf size = chunk.size();
    REQUIRE(compress(chunk.data(), &size, zeros.data(), count) == Z_OK);
    std::string bytes = pointing(good.size());
    const std::int32_t place[] = {0, 0, static_cast<std::int32_t>(size)};
    bytes.append(reinterpret_cast<const char*>(place), sizeof place);
    return bytes.append(reinterpret_cast<const char*>(chunk.data()), size);
  };
  check_refused(deflated(100'000'000),
                "'conditional': compressed values in it are damaged or too many");
  check_refused(deflated(100), "'conditional': lines of the EXR file are shorter than its part");
}
