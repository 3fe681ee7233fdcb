// Table files: what is saved comes back bit for bit from either format, a failed save changes
// nothing, and a file that is not one of ours or of another version is refused with a message that
// says so. Damaged files and wrong content are in table_corruption_test.cpp.
#include "vndf/io/table_file.h"

#include <sys/resource.h>

#include <csignal>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <random>

#include "support/catch.h"
#include "support/memory_limit.h"
#include "vndf/io/atomic_file.h"
#include "vndf/io/checksum_trailer.h"
#include "vndf/io/crc64.h"
#include "vndf/io/exr_reader.h"
#include "vndf/io/exr_writer.h"
#include "vndf/io/hdf5_reader.h"
#include "vndf/io/hdf5_writer.h"
#include "vndf/io/stored_tables.h"
#include "vndf/io/untrusted_file.h"

namespace {

using namespace vndf;
using namespace vndf::io;
using namespace vndf::test;
namespace fs = std::filesystem;

const std::vector<std::string> kExtensions{".h5", ".exr"};

/// An empty folder that goes with all it holds.
struct Folder {
  fs::path path = fs::temp_directory_path() / ("vndf-" + std::to_string(std::random_device{}()));
  Folder() { fs::create_directory(path); }
  ~Folder() { fs::remove_all(path); }
  fs::path operator/(const std::string& name) const { return path / name; }
  auto entries() const { return std::distance(fs::directory_iterator(path), {}); }
};

// By exactly rounded operations only, so that the checksum is the same on every machine.
std::vector<float> rows(std::size_t rows, std::size_t columns) {
  std::vector<float> values;
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t j = 0; j < columns; ++j) {
      const float t = static_cast<float>(j) / static_cast<float>(columns - 1);
      values.push_back(t * (t + static_cast<float>(i)) / static_cast<float>(i + 1));
    }
  return values;
}

LogCurveSegment<double> segment(double begin, double end, Grading grading, std::size_t nodes) {
  LogCurveSegment<double> s{begin, end, grading, {}};
  for (std::size_t i = 0; i < nodes; ++i) {
    const double a = begin + static_cast<double>(i) / 3;
    s.nodes.push_back({-a * a / 3, -2 * a / 3});
  }
  return s;
}

SlopeTables small_tables() {
  return {.distribution = "a test of \xce\xb1",
          .mean_slope = 1.0 / 3,
          .support = 4,
          .conditional_constant = 0.7,
          .conditional_quadratic = -1.0 / 3,
          .marginal = {5, 7, rows(5, 7)},
          .conditional = {4, 5, rows(4, 5)},
          .marginal_rows = {},
          .conditional_rows = {{0, 0}, {0.25, 0.5}, {0.75, 1}},
          .marginal_map = {{0, 0.25}, {0.125, 1.0 / 3}, {0.75, 0}},
          .log_ndf = {{segment(0, 1, Grading::both, 9), segment(1, 3, Grading::low, 4)}, false},
          .log_backfacing = {{segment(0, 3, Grading::none, 2)}, false}};
}

TableFile small_file(SlopeTables tables = small_tables()) {
  TableFile file{share(std::move(tables)),
                 {{"profile name:'a test'", {0, 0.25, 1.0 / 3, 1e300}, {1, 0.5, 1e-320, 0}},
                  "vndf build --profile 'a test'\n",
                  "vndf 1.2.3",
                  "two\nlines\n",
                  SurfaceSlopes{{1.0 / 3, 1e-9}, -0.1, {1.0 / 7, 1e-310}}},
                 {}};
  double figure = 1.0 / 7;
  for_each_figure(file.certificate, [&](const std::string&, double& v) { v = figure /= -3; });
  file.certificate.max_pdf_error = std::numeric_limits<double>::infinity();
  return file;
}

void put_bytes(const fs::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

std::string written(const std::string& extension, const StoredTables& stored) {
  return extension == ".h5" ? write_hdf5(stored) : write_exr(stored);
}

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const TableFileError& error) {
    return error.what();
  }
  return "no error";
}

/// The message of the error that load throws for these bytes.
std::string error_of(const std::string& bytes) {
  const Folder folder;
  put_bytes(folder / "given", bytes);
  return message_of([&] { load(folder / "given"); });
}

void check_says(const std::string& message, const std::vector<std::string>& parts) {
  INFO(message);
  for (const std::string& part : parts) CHECK(message.find(part) != std::string::npos);
}

/// Checks that a file with changed content and a valid trailer is refused, in either format.
void check_refused(const std::function<void(StoredTables&)>& change,
                   const std::vector<std::string>& parts) {
  for (const std::string& extension : kExtensions) {
    StoredTables stored = to_stored(small_file());
    change(stored);
    check_says(error_of(with_trailer(written(extension, stored))), parts);
  }
}

}  // namespace

TEST_CASE("a table file returns every bit that was saved") {
  const Folder folder;
  const TableFile file = small_file();
  for (const std::string& extension : kExtensions) {
    save(folder / ("t" + extension), file);
    const TableFile loaded = load(folder / ("t" + extension));
    CHECK(to_stored(loaded) == to_stored(file));
    CHECK(loaded.tables->distribution == file.tables->distribution);
    CHECK(loaded.provenance == file.provenance);
    CHECK(loaded.certificate.marginal.worst_row == file.certificate.marginal.worst_row);
  }
}

TEST_CASE("tables in double precision are kept, each by itself") {
  const Folder folder;
  SlopeTables tables = small_tables();
  const std::vector<float> single = rows(5, 7);
  tables.marginal = QuantileTable::with_double_values(5, 7, {single.begin(), single.end()});
  const TableFile file = small_file(tables);
  for (const std::string& extension : kExtensions) {
    save(folder / ("t" + extension), file);
    const TableFile loaded = load(folder / ("t" + extension));
    CHECK(to_stored(loaded) == to_stored(file));
    CHECK(loaded.tables->marginal.in_double());
    CHECK_FALSE(loaded.tables->conditional.in_double());
  }
}

TEST_CASE("a table file keeps empty texts and the longest") {
  const Folder folder;
  TableFile file = small_file();
  file.provenance = {.specification = {std::string(kMaxTextBytes, 'x')}, .command = ""};
  for (const std::string& extension : kExtensions) {
    save(folder / ("t" + extension), file);
    CHECK(to_stored(load(folder / ("t" + extension))) == to_stored(file));
  }
}

TEST_CASE("the same content gives the same bytes") {
  const Folder folder;
  for (const std::string& extension : kExtensions) {
    save(folder / ("a" + extension), small_file());
    save(folder / ("b" + extension), small_file());
    CHECK(read_file(folder / ("a" + extension)) == read_file(folder / ("b" + extension)));
  }
}

TEST_CASE("tables as bytes are those of a file, and errors name them") {
  const Folder folder;
  for (const std::string& extension : kExtensions) {
    const fs::path path = folder / ("a" + extension);
    save(path, small_file());
    const std::string bytes = to_bytes(format_for(path), small_file(), "mine");
    CHECK(bytes == read_file(path));
    CHECK(to_stored(from_bytes(bytes, "mine")) == to_stored(small_file()));
  }
  check_says(message_of([] { from_bytes("neither", "mine"); }), {"mine: ", "neither"});
}

TEST_CASE("the checks are those of the format page") {
  Crc64 crc;
  crc.add("1234");
  crc.add("56789");
  CHECK(hex_digits(crc.value()) == "995dc9bbdf1939fa");
  const Specification specification = small_file().provenance.specification;
  CHECK(hex_digits(content_checksum(small_tables(), specification)) == "6be715d26bdc6cb7");
}

TEST_CASE("the extension chooses the format of a new file") {
  CHECK(format_for("a/b.h5") == Format::hdf5);
  CHECK(format_for("b.HDF5") == Format::hdf5);
  CHECK(format_for("b.c.Exr") == Format::exr);
  for (const char* name : {"b", "b.png", "h5", "exr.d/b"})
    check_says(message_of([&] { format_for(name); }), {name, ".h5", ".hdf5", ".exr"});
}

TEST_CASE("a file is recognised by its content, whatever its name") {
  const Folder folder;
  save(folder / "t.h5", small_file());
  fs::rename(folder / "t.h5", folder / "t.exr");
  CHECK(to_stored(load(folder / "t.exr")) == to_stored(small_file()));
}

TEST_CASE("what is not a table file is refused") {
  const Folder folder;
  check_says(message_of([&] { load(folder / "none.h5"); }), {"none.h5", "no such file"});
  check_says(message_of([&] { load(folder.path); }), {folder.path.string(), "not a file"});
  check_says(error_of(""), {"given", "empty"});
  check_says(error_of("PNG and so on"), {"given", "neither an HDF5 nor an EXR file"});
}

TEST_CASE("HDF5 and EXR files of other programs are refused") {
  StoredTables foreign;
  foreign.attributes["title"] = "something else";
  foreign.arrays["marginal"] = foreign.arrays["other"] = {{2, 3}, std::vector<float>(6)};
  for (const std::string& extension : kExtensions) {
    check_says(error_of(written(extension, foreign)), {"another program wrote it"});
    check_says(error_of(with_trailer(written(extension, foreign))),
               {"file_type", "another program"});
  }
  check_refused([](StoredTables& s) { s.attributes["file_type"] = "a photo"; }, {"file_type"});
}

TEST_CASE("another major version is refused, before what it may have changed is looked at") {
  const auto version = [](int major, int minor) {
    return [=](StoredTables& s) {
      s.attributes["format_major"] = major;
      s.attributes["format_minor"] = minor;
      s.attributes.erase("mean_slope");
    };
  };
  check_refused(version(5, 1),
                {"format 5.1 is newer than this program reads; use a newer program"});
  check_refused(version(2, 0),
                {"format 2.0 is older than this program reads; build the table again"});
}

TEST_CASE("a newer minor version is read and what it added is ignored") {
  const Folder folder;
  StoredTables stored = to_stored(small_file());
  stored.attributes["format_minor"] = kFormatMinor + 1;
  stored.attributes["added"] = 1.5;
  stored.arrays["added"] = {{3, 1}, std::vector<float>(3)};
  for (const std::string& extension : kExtensions) {
    put_bytes(folder / "t", with_trailer(written(extension, stored)));
    CHECK(to_stored(load(folder / "t")) == to_stored(small_file()));
  }
}

TEST_CASE("a file without the surface of a map is of the minor version that had none") {
  TableFile file = small_file();
  CHECK(to_stored(file).attributes.at("format_minor") == Attribute(1));
  file.provenance.surface.reset();
  const StoredTables stored = to_stored(file);
  CHECK(stored.attributes.at("format_minor") == Attribute(0));
  CHECK_FALSE(stored.attributes.contains("surface"));
}

TEST_CASE("the surface of a map that breaks a rule is neither written nor read") {
  for (const char* text : {"", "0.3 0.1 0.5 0", "0.3 0.1 0.5 0 0 0", "0 0.1 0.5 0 0",
                           "0.3 0.1 -1 0 0", "0.3 0.1 0.5 inf 0", "0.3 0.1 0.5 0 nan"})
    check_refused([=](StoredTables& s) { s.attributes["surface"] = text; },
                  {std::string("its attribute 'surface' '") + text + "'",
                   "alpha_x, alpha_y (> 0), correlation (inside (-1, 1)), mean_x and mean_y"});
  check_refused([](StoredTables& s) { s.attributes["surface"] = 0.3; },
                {"the attribute 'surface' is not a text"});
  const Folder folder;
  TableFile file = small_file();
  file.provenance.surface->correlation = 1;
  check_says(message_of([&] { save(folder / "t.h5", file); }),
             {"of the surface of the map the correlation must be inside (-1, 1)"});
}

TEST_CASE("texts that would drive a terminal are neither written nor read") {
  for (const char* name : {"specification", "command", "program", "notes", "distribution"})
    check_refused([=](StoredTables& s) { s.attributes[name] = "\x1b[2J"; },
                  {std::string("'") + name + "' has a control character"});
  const Folder folder;
  TableFile file = small_file();
  file.provenance.notes = "\x1b[2J";
  check_says(message_of([&] { save(folder / "t.h5", file); }), {"'notes' has a control character"});
}

TEST_CASE("unknown coordinates are refused") {
  check_refused([](StoredTables& s) { s.attributes["coordinates"] = "polar"; },
                {"its coordinates 'polar' are unknown", "bounded-slope-3"});
}

namespace {

/// Tables of `side` rows and columns that deflate to very little: all is 0 but the last column.
TableFile uniform_file(std::size_t side) {
  std::vector<float> values;
  for (std::size_t i = 0; i < side; ++i)
    for (std::size_t j = 0; j < side; ++j) values.push_back(j + 1 < side ? 0.0f : 1.0f);
  SlopeTables tables = small_tables();
  tables.marginal = {side, side, values};
  tables.conditional = {side, side, values};
  return small_file(std::move(tables));
}

}  // namespace

TEST_CASE("the largest tables of a small file take at most 8 times the bytes of its arrays") {
  const Folder folder;
  constexpr std::size_t kSide = 1440;  // the square of it twice is just below 16 MiB of float32
  for (const std::string& extension : kExtensions) {
    const fs::path path = folder / ("t" + extension);
    save(path, uniform_file(kSide));
    std::size_t rows = 0;
    within_limits(8 * most_array_bytes(fs::file_size(path)),
                  [&] { rows = load(path).tables->marginal.rows(); });
    CHECK(rows == kSide);
  }
}

TEST_CASE("tables that a file of its size may not hold are not written") {
  const Folder folder;
  for (const std::string& extension : kExtensions)
    check_says(message_of([&] { save(folder / ("t" + extension), uniform_file(2000)); }),
               {"larger than a file of its size may hold", "make smaller tables"});
  CHECK(folder.entries() == 0);
}

namespace {

/// While it lives, no file of this process can grow beyond `bytes`: a disk that is full.
struct FullDisk {
  rlimit before{};
  explicit FullDisk(rlim_t bytes) {
    std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before);
    const rlimit limit{bytes, before.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FullDisk() {
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, SIG_DFL);
  }
};

TableFile other_file() {
  SlopeTables tables = small_tables();
  tables.mean_slope = 2;
  return small_file(std::move(tables));
}

}  // namespace

TEST_CASE("saving replaces the file that was there and leaves no other") {
  const Folder folder;
  save(folder / "t.h5", other_file());
  save(folder / "t.h5", small_file());
  CHECK(to_stored(load(folder / "t.h5")) == to_stored(small_file()));
  CHECK(folder.entries() == 1);
}

TEST_CASE("saving to a full disk leaves nothing behind and the file that was there as it was") {
  const Folder folder;
  for (const std::string& extension : kExtensions) {
    save(folder / ("old" + extension), other_file());
    const auto entries = folder.entries();
    for (const std::string name : {"old", "new"}) {
      const std::string message = message_of([&] {
        const FullDisk full(1000);
        save(folder / (name + extension), small_file());
      });
      check_says(message, {name + extension, "cannot be written", "make room"});
    }
    CHECK(folder.entries() == entries);
    CHECK(to_stored(load(folder / ("old" + extension))) == to_stored(other_file()));
  }
}

TEST_CASE("saving where no file can be made is refused") {
  const Folder folder;
  const auto saving = [&](const std::string& name) {
    return message_of([&] { save(folder / name, small_file()); });
  };
  check_says(saving("none/t.h5"), {"none/t.h5", "cannot be created", "folder"});
  fs::create_directory(folder / "t.exr");
  check_says(saving("t.exr"), {"t.exr", "cannot be replaced"});
  CHECK(folder.entries() == 1);
}

TEST_CASE("saving what could not be loaded is refused") {
  const Folder folder;
  const auto saving = [&](const TableFile& file) {
    return message_of([&] { save(folder / "t.h5", file); });
  };
  SlopeTables broken = small_tables();
  broken.mean_slope = -1;
  TableFile file = small_file();
  file.tables = std::make_shared<const SlopeTables>(broken);
  check_says(saving(file), {"t.h5", "break a rule", "mean slope"});
  check_says(saving(TableFile{}), {"no tables"});
  file = small_file();
  file.provenance.command = std::string(kMaxTextBytes + 1, 'x');
  check_says(saving(file), {"'command' is longer than 60000 bytes", "shorten"});
  file = small_file();
  file.provenance.specification.text = std::string("a\0b", 3);
  check_says(saving(file), {"'specification' has a zero byte"});
  file = small_file();
  file.provenance.specification.r.push_back(9);
  check_says(saving(file), {"5 radii and 4 densities"});
  file = small_file();
  file.provenance.specification.p22[2] = std::numeric_limits<double>::quiet_NaN();
  check_says(saving(file), {"not a finite number"});
  file.provenance.specification.r = file.provenance.specification.p22 =
      std::vector<double>(kMaxSamples + 1);
  check_says(saving(file), {"more than 1048576 samples"});
  CHECK(folder.entries() == 0);
}
