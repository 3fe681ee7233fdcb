// Damaged table files, and whole ones with wrong content. Whatever happens to the bytes of a file,
// loading it either throws TableFileError or returns exactly what was saved.
#include <array>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <limits>
#include <random>

#include "io/small_table_file.h"
#include "support/catch.h"
#include "vndf/io/checksum_trailer.h"
#include "vndf/io/crc64.h"
#include "vndf/io/exr_reader.h"
#include "vndf/io/exr_writer.h"
#include "vndf/io/format_error.h"
#include "vndf/io/hdf5_reader.h"
#include "vndf/io/hdf5_writer.h"
#include "vndf/io/stored_tables.h"
#include "vndf/io/table_file.h"

namespace {

using namespace vndf;
using namespace vndf::io;
using namespace vndf::test;
namespace fs = std::filesystem;

constexpr std::size_t kRows = kSmallRows, kColumns = kSmallColumns, kNodes = kSmallNodes;
constexpr int kCorruptions = 10000;  // in each format

struct FormatCase {
  std::string name;
  std::function<std::string(const StoredTables&)> write;
  std::function<StoredTables(std::string_view)> read;
};

const std::vector<FormatCase> kFormats{{"HDF5", write_hdf5, read_hdf5},
                                       {"EXR", write_exr, read_exr}};

/// A file that is rewritten for every corruption, in a folder of its own.
struct ScratchFile {
  fs::path folder = fs::temp_directory_path() / ("vndf-" + std::to_string(std::random_device{}()));
  fs::path path = folder / "table";
  ScratchFile() { fs::create_directory(folder); }
  ~ScratchFile() { fs::remove_all(folder); }
  /// Makes a new file each time: rewriting one in place waits for the disk on some file systems.
  void put(const std::string& bytes) const {
    fs::remove(path);
    std::ofstream(path, std::ios::binary) << bytes;
  }
};

/// What load says about the file: "same", "different" or the error.
std::string outcome(const fs::path& path, const StoredTables& written) {
  try {
    return to_stored(load(path)) == written ? "same" : "different";
  } catch (const TableFileError& error) {
    return error.what();
  }
}

// Random corruptions.

using Random = std::mt19937_64;

std::size_t below(std::size_t n, Random& random) {
  return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
}

char any_byte(Random& random) {
  return static_cast<char>(below(256, random));
}

void flip_bits(std::string& bytes, Random& random) {
  for (std::size_t n = 1 + below(8, random); n > 0; --n)
    bytes[below(bytes.size(), random)] ^= static_cast<char>(1 << below(8, random));
}

void overwrite_bytes(std::string& bytes, Random& random) {
  for (std::size_t n = 1 + below(8, random); n > 0; --n)
    bytes[below(bytes.size(), random)] = any_byte(random);
}

void truncate(std::string& bytes, Random& random) {
  bytes.resize(below(bytes.size(), random));
}

void insert_bytes(std::string& bytes, Random& random) {
  bytes.insert(below(bytes.size() + 1, random), 1 + below(8, random), any_byte(random));
}

void delete_bytes(std::string& bytes, Random& random) {
  bytes.erase(below(bytes.size(), random), 1 + below(8, random));
}

void corrupt(std::string& bytes, Random& random) {
  constexpr auto kWays =
      std::to_array({flip_bits, overwrite_bytes, truncate, insert_bytes, delete_bytes});
  kWays[below(kWays.size(), random)](bytes, random);
}

/// The seed of the corruptions, from the environment for long runs with others.
std::uint64_t seed() {
  const char* given = std::getenv("VNDF_TEST_SEED");
  return given != nullptr ? std::strtoull(given, nullptr, 10) : 20140624;
}

// Wrong content.

/// Checks that changed content is refused with these words after a round trip through each format.
void check_refused(const std::function<void(StoredTables&)>& change,
                   const std::vector<std::string>& parts, std::size_t formats = kFormats.size()) {
  StoredTables stored = to_stored(small_table_file());
  change(stored);
  for (std::size_t f = 0; f < formats; ++f) {
    std::string message = "no error";
    try {
      from_stored(kFormats[f].read(kFormats[f].write(stored)));
    } catch (const FormatError& error) {
      message = error.what();
    }
    INFO(kFormats[f].name << ": " << message);
    for (const std::string& part : parts) CHECK(message.find(part) != std::string::npos);
  }
}

constexpr std::size_t kOnlyHdf5 = 1;

std::function<void(StoredTables&)> replace(const std::string& name, const Array& array) {
  return [=](StoredTables& stored) { stored.arrays[name] = array; };
}

/// Puts wrong values into the marginal table as a program would that takes them for right.
std::function<void(StoredTables&)> marginal_with(std::size_t index, float value) {
  return [=](StoredTables& stored) {
    std::vector<float> values = small_rows();
    values[index] = value;
    SlopeTables tables = *small_table_file().tables;
    tables.marginal = {kRows, kColumns, values};
    stored.arrays["marginal"].values = values;
    stored.attributes["content_checksum"] =
        hex_digits(content_checksum(tables, small_table_file().provenance.specification));
  };
}

}  // namespace

TEST_CASE("a corrupted file is refused or returns exactly what was saved") {
  const ScratchFile file;
  const StoredTables written = to_stored(small_table_file());
  Random random(seed());
  for (const FormatCase& format : kFormats) {
    const std::string good = with_trailer(format.write(written));
    int same = 0;
    for (int i = 0; i < kCorruptions; ++i) {
      std::string bytes = good;
      corrupt(bytes, random);
      file.put(bytes);
      const std::string result = outcome(file.path, written);
      INFO(format.name << ", corruption " << i << " of seed " << seed());
      if (result == "same") ++same;
      if (result == "different" || (result == "same" && bytes != good)) FAIL(result);
    }
    // A byte overwritten by itself is no corruption; it must not be most of them.
    CHECK(same < kCorruptions / 100);
  }
}

TEST_CASE("a file cut short anywhere is refused") {
  const ScratchFile file;
  const StoredTables written = to_stored(small_table_file());
  for (const FormatCase& format : kFormats) {
    const std::string good = with_trailer(format.write(written));
    for (std::size_t length = 0; length < good.size(); ++length) {
      file.put(good.substr(0, length));
      REQUIRE_THROWS_AS(load(file.path), TableFileError);
    }
    CHECK(outcome(file.path, written).find("cut short") != std::string::npos);
  }
}

TEST_CASE("a file with a byte changed, added or lost is refused") {
  const ScratchFile file;
  const StoredTables written = to_stored(small_table_file());
  const auto check = [&](const std::string& bytes, const std::string& part) {
    file.put(bytes);
    const std::string message = outcome(file.path, written);
    INFO(message);
    CHECK(message.find(part) != std::string::npos);
  };
  for (const FormatCase& format : kFormats) {
    const std::string good = with_trailer(format.write(written));
    std::string changed = good;
    changed[good.size() / 2] ^= 1;
    check(good, "same");
    check(changed, "damaged");
    check(good + "\n", "changed");
    check(std::string(good).erase(good.size() / 2, 1), "damaged");
  }
}

TEST_CASE("the content checksum depends on the tables and their specification alone") {
  const auto checksum = [](const SlopeTables& tables, const Provenance& provenance) {
    return content_checksum(tables, provenance.specification);
  };
  const TableFile good = small_table_file();
  const auto differs = [&](const std::function<void(SlopeTables&)>& change) {
    SlopeTables tables = *good.tables;
    change(tables);
    return checksum(tables, good.provenance) != checksum(*good.tables, good.provenance);
  };
  CHECK(differs([](SlopeTables& t) { t.mean_slope = 0.5; }));
  CHECK(differs([](SlopeTables& t) { t.marginal = {kColumns, kRows, small_rows()}; }));
  CHECK(differs([](SlopeTables& t) { t.conditional = {kRows / 2, kColumns * 2, small_rows()}; }));
  CHECK(differs([](SlopeTables& t) { t.support = 9; }));
  CHECK(differs([](SlopeTables& t) { t.conditional_constant = 4; }));
  CHECK(differs([](SlopeTables& t) { t.conditional_quadratic = 0; }));
  CHECK(differs([](SlopeTables& t) { t.marginal_map[1].tangent = 0.25; }));
  CHECK(differs([](SlopeTables& t) { t.marginal_rows = {}; }));
  CHECK(differs([](SlopeTables& t) { t.conditional_rows = {{0, 0}, {0.5, 1}}; }));
  CHECK(differs([](SlopeTables& t) {
    auto segments = t.log_ndf.segments();
    segments[0].grading = Grading::none;
    t.log_ndf = {segments, true};
  }));
  CHECK(differs([](SlopeTables& t) {
    t.log_backfacing = {{{0, 0.5, Grading::none, {{0, 0}, {-1, 0}}}}, true};
  }));
  CHECK_FALSE(differs([](SlopeTables& t) { t.distribution = "another name"; }));

  const auto provenance_differs = [&](const std::function<void(Provenance&)>& change) {
    Provenance provenance = good.provenance;
    change(provenance);
    return checksum(*good.tables, provenance) != checksum(*good.tables, good.provenance);
  };
  CHECK(provenance_differs([](Provenance& p) { p.specification.text = "ggx"; }));
  CHECK(provenance_differs([](Provenance& p) { p.specification.r[1] = 0.25; }));
  CHECK(provenance_differs([](Provenance& p) { p.specification.p22[3] = 0.25; }));
  CHECK_FALSE(provenance_differs([](Provenance& p) { p.command = p.program = p.notes = "x"; }));
}

TEST_CASE("tables that do not match their checksum are refused") {
  const auto damaged = [](const auto& change) { check_refused(change, {"damaged", "checksum"}); };
  damaged([](StoredTables& s) { s.attributes["mean_slope"] = 1.25; });
  damaged([](StoredTables& s) { s.attributes["support"] = 3.0; });
  damaged([](StoredTables& s) { s.attributes["content_checksum"] = "0"; });
  damaged(replace("log_ndf", {{kNodes, 2}, std::vector<double>(2 * kNodes)}));
  damaged(replace("marginal_rows", {{2, 2}, std::vector<double>{0, 0, 1, 1}}));
  damaged(replace("log_ndf_segments", {{1, 4}, std::vector<double>{0, 5, 1, double{kNodes}}}));
  damaged(replace("marginal", {{kColumns, kRows}, small_rows()}));
  damaged([](StoredTables& s) { s.attributes["specification"] = "ggx"; });
  damaged(replace("profile_samples", {{3, 2}, std::vector<double>{0, 1, 0.5, 0.75, 1, 0}}));
  damaged([](StoredTables& s) { s.arrays.erase("profile_samples"); });
}

TEST_CASE("values that break a rule are refused even where the checksum is right") {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  check_refused(marginal_with(kColumns + 3, kNan),
                {"marginal table, row 1", "not a finite number"});
  check_refused(marginal_with(kColumns + 3, 0), {"row 1", "below the column before it"});
  check_refused(marginal_with(kColumns - 1, 2), {"row 0", "outside [0, 1]"});
}

TEST_CASE("samples that break a rule are refused even where the checksum is right") {
  const auto refused = [](double r, double p22, const std::vector<std::string>& parts) {
    const auto change = [=](StoredTables& s) {
      TableFile file = small_table_file();
      Specification& specification = file.provenance.specification;
      specification.r[1] = r;
      specification.p22[1] = p22;
      s.arrays["profile_samples"].values = std::vector<double>{0, 1, r, p22, 1, 0.5, 2, 0};
      s.attributes["content_checksum"] = hex_digits(content_checksum(*file.tables, specification));
    };
    check_refused(change, parts);
  };
  refused(std::numeric_limits<double>::quiet_NaN(), 1, {"a sample", "not a finite number"});
  refused(0.5, std::numeric_limits<double>::infinity(), {"a sample", "not a finite number"});
  const std::string shape = "'profile_samples' has the shape ";
  check_refused(replace("profile_samples", {{2, 4}, std::vector<double>(8)}), {shape + "2 x 4"});
  check_refused(replace("profile_samples", {{8}, std::vector<double>(8)}), {shape + "8,"},
                kOnlyHdf5);
  check_refused(replace("profile_samples", {{4, 2}, std::vector<float>(8)}), {"are not float64"});
  constexpr std::size_t kMany = kMaxSamples + 1;
  check_refused(replace("profile_samples", {{kMany, 2}, std::vector<double>(2 * kMany)}),
                {shape + "1048577 x 2"}, kOnlyHdf5);
}

TEST_CASE("any attribute missing or of another type is refused") {
  for (const auto& item : to_stored(small_table_file()).attributes) {
    const std::string& name = item.first;
    const bool is_text = std::holds_alternative<std::string>(item.second);
    const Attribute other = is_text ? Attribute(1.0) : Attribute("text");
    if (name != kSurface)  // which only the tables of a map have
      check_refused([&](StoredTables& s) { s.attributes.erase(name); }, {"'" + name + "' is"});
    check_refused([&](StoredTables& s) { s.attributes[name] = other; }, {"'" + name + "' is not"});
  }
}

TEST_CASE("any array missing, of another type or of another shape is refused") {
  for (const std::string name :
       {"marginal", "conditional", "log_ndf", "log_backfacing", "marginal_rows", "marginal_map"}) {
    const std::string shape = "'" + name + "' has the shape ";
    check_refused([&](StoredTables& s) { s.arrays.erase(name); }, {"'" + name + "' is missing"});
    check_refused(replace(name, {{9, 1}, std::vector<double>(9)}), {shape + "9 x 1"});
    check_refused(replace(name, {{1, 3}, std::vector<float>(3)}), {shape + "1 x 3"});
    check_refused(replace(name, {{35}, std::vector<float>(35)}), {shape + "35,"}, kOnlyHdf5);
  }
  // Tables may be of either type, and of no third.
  for (const std::string name : {"log_ndf", "log_backfacing", "marginal_rows", "marginal_map"})
    check_refused(replace(name, {{9, 2}, std::vector<float>(18)}),
                  {"'" + name + "' are not float64"});
  check_refused(replace("log_ndf", {{6, 3}, std::vector<double>(18)}), {"6 x 3", "rows x 2"});
}

TEST_CASE("an array over the limits of the format is refused unread") {
  constexpr std::size_t kTall = kMaxTableSide + 1, kLong = kMaxCurveNodes + 1;
  check_refused(replace("marginal", {{kTall, 3}, std::vector<float>(kTall * 3)}),
                {"'marginal' has the shape 16385 x 3", "at most 16384 x 16384"});
  check_refused(replace("log_ndf", {{kLong, 2}, std::vector<double>(kLong * 2)}),
                {"'log_ndf' has the shape 1048577 x 2"}, kOnlyHdf5);
}

TEST_CASE("segments that do not count the nodes of their curve are refused") {
  const auto with_count = [](double count) {
    return replace("log_ndf_segments", {{1, 4}, std::vector<double>{0, 4, 1, count}});
  };
  check_refused(with_count(kNodes + 1.0), {"counts more nodes"});
  check_refused(with_count(kNodes - 1.0), {"counts fewer nodes"});
  check_refused(with_count(-1), {"counts more nodes"});
  check_refused(with_count(std::numeric_limits<double>::quiet_NaN()), {"counts more nodes"});
}
