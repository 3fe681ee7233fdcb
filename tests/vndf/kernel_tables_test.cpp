// The block of a kernel: one that is damaged, cut, foreign or not good enough is an error that
// names its rule, and one that is accepted is never read outside its bytes.
#include "vndf/kernel_tables.h"

#include <sys/stat.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <string>

#include "support/baked_tables.h"
#include "support/catch.h"
#include "support/directions.h"

using namespace vndf;
using namespace vndf::test;

namespace {

/// The smallest block that the tests of damage go through byte by byte.
const KernelTables& smallest() {
  static const KernelTables tables =
      bake(*small_tables("ggx").tables, {.tolerance = kMostTolerance});
  return tables;
}

/// The same with a map and rows of y.
const KernelTables& smallest_with_rows() {
  static const KernelTables tables =
      bake(*small_tables(kMixture).tables, {.tolerance = kMostTolerance});
  return tables;
}

/// Reads from all over the tables; the sanitizers watch.
void use(const Kernel& kernel) {
  for (const double theta : {0.0, 1e-6, 30.0, 89.0, 90.0})
    for (const float u : {0.0f, 1e-6f, 0.3f, 0.5f, 0.7f, 1.0f}) {
      const Vec3<float> wi = direction_at<float>(theta, 40);
      const Vec3<float> wm = kernel.sample_with_density(wi, {0.5f, 0.2f}, u, 1 - u).wm;
      (void)kernel.sample(wi, {0.5f, 0.2f}, u, u);
      (void)kernel.invert(wi, wm, {0.5f, 0.2f});
      (void)kernel.pdf(wi, wm, {0.5f, 0.2f});
    }
}

/// Whether the bytes are taken for tables; these are then used.
bool accepted(std::span<const std::byte> bytes) {
  try {
    use(KernelTables::view(bytes).kernel());
    return true;
  } catch (const KernelTablesError&) {
    return false;
  }
}

std::string error_of(std::span<const std::byte> bytes) {
  try {
    KernelTables::view(bytes);
  } catch (const KernelTablesError& e) {
    return e.what();
  }
  return "accepted";
}

/// A file that is gone after the test.
class File {
 public:
  explicit File(std::span<const std::byte> bytes)
      : path_(std::filesystem::temp_directory_path() / "vndf-kernel-tables-test.vndf") {
    std::ofstream(path_, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
  }
  ~File() { std::filesystem::remove(path_); }
  File(const File&) = delete;
  File& operator=(const File&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace

TEST_CASE("tables in memory, copied and loaded from a file are the same") {
  Block block(smallest().bytes());
  const KernelTables seen = KernelTables::view(block.bytes());
  CHECK(seen.bytes().data() == block.data());
  const File file(block.bytes());
  const KernelTables loaded = load(file.path());
  std::optional<KernelTables> copied = KernelTables::copy(block.bytes());
  const KernelTables shared = *copied;
  copied.reset();
  for (const KernelTables& tables : {loaded, shared}) {
    CHECK(std::ranges::equal(tables.bytes(), smallest().bytes()));
    CHECK(reinterpret_cast<std::uintptr_t>(tables.bytes().data()) % kKernelAlignment == 0);
  }
  CHECK(same(loaded.kernel().sample({0.6f, 0, 0.8f}, {1, 1}, 0.3f, 0.7f),
             seen.kernel().sample({0.6f, 0, 0.8f}, {1, 1}, 0.3f, 0.7f)));
}

TEST_CASE("texts and a certificate are kept beside the same numbers") {
  Certificate certificate;
  certificate.marginal.max_u_error = 1e-5;
  certificate.max_pdf_error = 2e-5;
  const KernelText text{"a name",
                        {{"profile", {0, 0.5, 2}, {1, 1.0 / 3, 0}},
                         "vndf build",
                         "vndf 1",
                         "one\ntwo\n",
                         SurfaceSlopes{{1.0 / 3, 0.1}, -0.5, {2, -1e-310}}}};
  const KernelTables tables = smallest().with_certificate(certificate, true).with_text(text);
  const KernelTables again = KernelTables::copy(tables.bytes());
  CHECK(again.text().distribution == "a name");
  CHECK(again.text().provenance == text.provenance);
  CHECK(tables.with_text({"another"}).text().provenance == Provenance());
  CHECK(again.certificate().marginal.max_u_error == 1e-5);
  CHECK(again.certificate().max_pdf_error == 2e-5);
  CHECK(again.header().certified == 1);
  CHECK(again.sampling_bytes() == smallest().sampling_bytes());
  CHECK(smallest().header().certified == 0);
}

TEST_CASE("samples and texts outside of the rules are neither written nor read") {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const auto writing = [](const Specification& specification) {
    try {
      smallest().with_text({"", {specification}});
    } catch (const KernelTablesError& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  CHECK_THAT(writing({"profile", {0, 1}, {1, kNan}}), contains("not a finite number"));
  CHECK_THAT(writing({"profile", {0, 1}, {1}}), contains("2 radii and 1 densities"));
  CHECK_THAT(writing({std::string("a\0b", 3)}), contains("'specification' has a zero byte"));
  CHECK_THAT(writing({std::string(kMaxTextBytes + 1, 'x')}), contains("longer than 60000 bytes"));

  const KernelTables tables = smallest().with_text({"", {{"profile", {0, 1}, {1, 0}}}});
  const auto reading = [&](auto change) {
    Block block(tables.bytes());
    change(block);
    block.set_checksum();
    return error_of(block.bytes());
  };
  CHECK_THAT(reading([&](Block& b) {
               std::memcpy(b.data() + b.header().samples + 8, &kNan, sizeof kNan);
             }),
             contains("a sample is not a finite number"));
  const auto misplaced = contains("the samples and texts are not the end of the block");
  CHECK_THAT(reading([](Block& b) { b.header().sample_count += 1; }), misplaced);
  CHECK_THAT(reading([](Block& b) { b.header().sample_count = 0x10000001; }), misplaced);
  CHECK_THAT(reading([](Block& b) { b.header().samples += 8; }), misplaced);
  CHECK_THAT(reading([](Block& b) { b.header().samples = 16; }), misplaced);
  CHECK_THAT(reading([](Block& b) { b.header().text_bytes -= 1; }), misplaced);
  CHECK_THAT(reading([](Block& b) { b.data()[b.size() - 1] = std::byte{'x'}; }),
             contains("a text has no end"));
}

TEST_CASE("the surface of a map outside of the rules is neither written nor read") {
  const SurfaceSlopes slopes{{0.3, 0.1}, 0.5, {1, 2}};
  Provenance broken{.specification = {}, .surface = slopes};
  broken.surface->alpha.x = 0;
  CHECK_THROWS_WITH(smallest().with_text({"", broken}),
                    contains("of the surface of the map alpha must be finite and > 0"));

  const KernelTables tables = smallest().with_text({"", {.specification = {}, .surface = slopes}});
  const std::string text = text_of(slopes);
  for (const std::string& other : {std::string("0.3 0.1 1.5 1 2"), std::string("0.3 0.1 0.5 1  "),
                                   std::string("0.3 0.1 0.5\0"
                                               "1 2",
                                               15)}) {
    REQUIRE(other.size() == text.size());
    Block block(tables.bytes());
    std::memcpy(block.data() + block.size() - text.size() - 1, other.data(), other.size());
    block.set_checksum();
    CHECK_THAT(error_of(block.bytes()), contains("the surface of the map breaks a rule"));
  }
}

TEST_CASE(
    "tables without the surface of a map have the bytes that they had before there were any") {
  const KernelTables tables = smallest().with_text({"a", {{"b"}, "c", "d", "e"}});
  const std::string_view bytes(reinterpret_cast<const char*>(tables.bytes().data()),
                               tables.bytes().size());
  CHECK(bytes.ends_with(std::string_view("a\0b\0c\0d\0e\0", 10)));
  CHECK_FALSE(tables.text().provenance.surface);
}

TEST_CASE("a unit with which the place of a direction is no number is refused") {
  for (const float unit : {1e-40f, 1e-30f, 1e30f, 1e38f}) {
    Block block(smallest().bytes());
    block.header().unit = unit;
    block.set_checksum();
    CHECK_THAT(error_of(block.bytes()), contains("the unit of slopes is not a moderate number"));
  }
}

TEST_CASE("segments of curves that share their guides are refused, for they could take hours") {
  Block block(smallest().bytes());
  kernel::VndfCurve& curve = block.header().ndf;
  KernelSegment segment;
  std::memcpy(&segment, block.data() + curve.segments, sizeof segment);
  // All that follows the first guide, in each of six segments in place of the certificate.
  constexpr std::size_t kPlace = offsetof(KernelHeader, certificate), kSegments = 6;
  static_assert(kSegments * sizeof segment <= sizeof(KernelHeader::certificate));
  const std::uint32_t guide = segment.guide + (segment.first_key << 3);
  segment.count = static_cast<std::uint32_t>((block.header().samples - guide) / 8);
  std::memset(block.data() + guide, 0, std::size_t{segment.count} * 8);
  const float length = segment.end - segment.begin;
  for (std::size_t k = 0; k < kSegments; ++k) {
    segment.begin = static_cast<float>(k) * length;
    segment.end = segment.begin + length;
    std::memcpy(block.data() + kPlace + k * sizeof segment, &segment, sizeof segment);
  }
  curve = {kPlace, kSegments};
  block.set_checksum();
  CHECK_THAT(error_of(block.bytes()), contains("share their guides"));
}

TEST_CASE("a text that would drive a terminal is neither written nor read") {
  for (const std::string text : {"\x1b[2J", "a\tb", "\x7f",
                                 "\xc2\x9b"
                                 "2J"}) {
    CHECK(has_control_character(text));
    CHECK_THROWS_AS(smallest().with_text({text}), KernelTablesError);
    Block block(smallest().with_text({std::string(text.size(), 'x')}).bytes());
    std::memcpy(block.data() + block.header().text, text.data(), text.size());
    block.set_checksum();
    CHECK_THAT(error_of(block.bytes()), contains("a text has a control character"));
  }
  CHECK_FALSE(has_control_character("two lines\nof \xce\xb1 and \xc2\xa0"));
}

TEST_CASE("a block that was cut anywhere is an error") {
  Block block(smallest().bytes());
  std::size_t taken = 0;
  for (std::size_t length = 0; length < block.size(); ++length)
    taken += accepted(block.first(length)) ? 1 : 0;
  CHECK(taken == 0);
}

TEST_CASE("a block that was cut and given a right checksum is never read beyond its end") {
  constexpr std::size_t kStep = 16;
  for (std::size_t length = sizeof(KernelHeader); length < smallest().bytes().size();
       length += kStep) {
    Block block(smallest().bytes().first(length));
    block.header().bytes = length;
    block.header().samples = block.header().text = static_cast<std::uint32_t>(length);
    block.header().sample_count = block.header().text_bytes = 0;
    block.set_checksum();
    accepted(block.bytes());
  }
}

TEST_CASE("a change of any byte is found by the checksum") {
  Block block(smallest().bytes());
  constexpr std::size_t kStep = 61;  // of no period in common with the block
  const std::size_t checksum = offsetof(KernelHeader, checksum);
  std::size_t taken = 0;
  for (std::size_t at = 0; at < block.size(); at += at < sizeof(KernelHeader) ? 1 : kStep) {
    block.data()[at] ^= std::byte{0x10};
    taken += at / 8 != checksum / 8 && accepted(block.bytes()) ? 1 : 0;
    block.data()[at] ^= std::byte{0x10};
  }
  CHECK(taken == 0);
  CHECK(accepted(block.bytes()));
}

TEST_CASE("a header of any bytes under a right checksum is an error or harmless") {
  for (const KernelTables* tables : {&smallest(), &smallest_with_rows()}) {
    Block block(tables->bytes());
    for (std::size_t at = 0; at < sizeof(KernelHeader); ++at)
      for (const int change : {1, 2, 4, 8, 0x10, 0x20, 0x40, 0x80, 0xff}) {
        const std::byte kept = block.data()[at];
        block.data()[at] ^= static_cast<std::byte>(change);
        block.set_checksum();
        accepted(block.bytes());
        block.data()[at] = kept;
      }
    block.set_checksum();
    CHECK(accepted(block.bytes()));
  }
}

TEST_CASE("each error_of names its rule") {
  Block block(smallest().bytes());
  CHECK_THAT(error_of(block.first(20)), contains("shorter than the header"));
  CHECK_THAT(error_of(block.first(block.size() - 1)), contains("fewer or more"));
  block.data()[0] ^= std::byte{1};
  CHECK_THAT(error_of(block.bytes()), contains("not a file of baked tables"));
  block.data()[0] ^= std::byte{1};
  block.header().version = 9;
  CHECK_THAT(error_of(block.bytes()), contains("version 9") && contains("reads 3"));
  block.header().version = kKernelVersion;
  block.header().unit = -1;
  CHECK_THAT(error_of(block.bytes()), contains("checksum"));
  block.set_checksum();
  CHECK_THAT(error_of(block.bytes()), contains("the unit of slopes"));
}

TEST_CASE("a block must begin where vectors can be read") {
  constexpr std::size_t kApart = 16;
  std::vector<std::byte> space(kApart);
  space.insert(space.end(), smallest().bytes().begin(), smallest().bytes().end());
  Block block(space);
  const auto apart = block.bytes().subspan(kApart);
  CHECK_THAT(error_of(apart), contains("multiple of 64"));
  use(KernelTables::copy(apart).kernel());
}

TEST_CASE("a file is an error if its certificate admits more than is asked for") {
  Certificate certificate;
  certificate.marginal.max_u_error = 2e-6;
  certificate.conditional.max_u_error = 7e-6;
  const File file(smallest().with_certificate(certificate, true).bytes());
  CHECK_NOTHROW(load(file.path(), {.max_u_error = 7e-6}));
  CHECK_THROWS_WITH(load(file.path(), {.max_u_error = 5e-6}),
                    contains(file.path().string()) && contains("7e-06") && contains("5e-06") &&
                        contains("--tolerance"));
}

TEST_CASE("a file is an error if a figure of its certificate is no number") {
  for (const bool first : {true, false}) {
    Certificate certificate;
    (first ? certificate.marginal : certificate.conditional).max_u_error =
        std::numeric_limits<double>::quiet_NaN();
    const File file(smallest().with_certificate(certificate, true).bytes());
    CHECK_THROWS_WITH(load(file.path(), {.max_u_error = 1e-5}), contains("u-error of nan"));
  }
}

TEST_CASE("a file that is none of baked tables is an error by name") {
  CHECK_THROWS_WITH(load("missing.vndf"), contains("missing.vndf: cannot be read"));
  const std::string foreign = "not a block";
  const File file(std::as_bytes(std::span(foreign)));
  CHECK_FALSE(is_kernel_file(file.path()));
  CHECK_FALSE(is_kernel_file("missing.vndf"));
  const std::filesystem::path pipe = file.path().string() + ".pipe";
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  CHECK_FALSE(is_kernel_file(pipe));  // and does not wait for somebody to write
  CHECK_THROWS_WITH(load(pipe), contains("cannot be read"));
  std::filesystem::remove(pipe);
  CHECK_THROWS_WITH(load(file.path()), contains(file.path().string()));
  CHECK(is_kernel_file(File(smallest().bytes()).path()));
}
