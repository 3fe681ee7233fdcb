// Mutants of honest files with right checksums, as somebody makes them who wants to do harm. Each
// is refused with a message or gives tables from which samples can be drawn; none crashes, takes
// long or takes much memory.
//
// VNDF_TEST_MUTANTS sets how many there are of each format, and VNDF_TEST_SEED others. A million of
// each take about ten minutes.
#include <sys/mman.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <functional>
#include <map>
#include <random>

#include "io/small_table_file.h"
#include "support/baked_tables.h"
#include "support/catch.h"
#include "support/memory_limit.h"
#include "vndf/io/checksum_trailer.h"
#include "vndf/io/exr_reader.h"
#include "vndf/io/exr_writer.h"
#include "vndf/io/format_error.h"
#include "vndf/io/hdf5_reader.h"
#include "vndf/io/hdf5_writer.h"
#include "vndf/io/stored_tables.h"
#include "vndf/tabulated_sampler.h"

namespace {

using namespace vndf;
using namespace vndf::io;
using namespace vndf::test;
namespace fs = std::filesystem;

using Random = std::mt19937_64;

/// What one mutant may take.
constexpr double kMostSeconds = 5;
/// From so many on, somebody measures: a test that others run must not depend on the time.
constexpr std::uint64_t kMany = 100'000;
constexpr std::size_t kMostBytes = 500'000'000;

std::uint64_t from_environment(const char* name, std::uint64_t otherwise) {
  const char* given = std::getenv(name);
  return given != nullptr ? std::strtoull(given, nullptr, 10) : otherwise;
}

std::size_t below(std::size_t n, Random& random) {
  return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
}

// Ways to change bytes. `bytes` is never empty.

void flip_bit(std::string& bytes, Random& random) {
  bytes[below(bytes.size(), random)] ^= static_cast<char>(1 << below(8, random));
}

void set_byte(std::string& bytes, Random& random) {
  bytes[below(bytes.size(), random)] = static_cast<char>(below(256, random));
}

void cut(std::string& bytes, Random& random) {
  bytes.resize(1 + below(bytes.size(), random));
}

/// Copies a piece over another place, or in between.
void splice(std::string& bytes, Random& random) {
  const std::string piece = bytes.substr(below(bytes.size(), random), 1 + below(64, random));
  const std::size_t at = below(bytes.size(), random);
  bytes.replace(at, below(2, random) * piece.size(), piece);
}

/// A number that is likely to be at the edge of something: a power of two, one more or less, a
/// place in the file or beyond its end, all ones.
std::uint64_t edge(const std::string& bytes, Random& random) {
  switch (below(4, random)) {
    case 0:
      return (std::uint64_t{1} << below(64, random)) + below(3, random) - 1;
    case 1:
      return below(bytes.size() + 16, random);
    case 2:
      return below(bytes.size() / 8, random) * 8;
    default:
      return ~std::uint64_t{0} - below(9, random);
  }
}

/// A field of one to eight bytes, at a multiple of its size.
void set_number(std::string& bytes, Random& random) {
  const std::size_t size = std::size_t{1} << below(4, random);
  if (bytes.size() < size) return;
  const std::uint64_t number = edge(bytes, random);
  std::memcpy(bytes.data() + below(bytes.size() / size, random) * size, &number, size);
}

/// An address or a length in place of another: this makes circles and shared parts.
void copy_number(std::string& bytes, Random& random) {
  constexpr std::size_t kSize = 8;
  if (bytes.size() < kSize) return;
  const auto place = [&] { return bytes.data() + below(bytes.size() / kSize, random) * kSize; };
  char number[kSize];
  std::memcpy(number, place(), kSize);
  std::memcpy(place(), number, kSize);
}

/// One to four changes, most of them to a part where an honest file has structure and not values.
void mutate(std::string& bytes, std::size_t structure, Random& random) {
  constexpr auto kWays = std::to_array(
      {flip_bit, set_byte, cut, splice, set_number, set_number, set_number, copy_number});
  for (std::size_t n = 1 + below(4, random); n > 0; --n) {
    const std::size_t size =
        below(4, random) > 0 ? std::min(structure, bytes.size()) : bytes.size();
    std::string part = bytes.substr(0, size);
    kWays[below(kWays.size(), random)](part, random);
    bytes.replace(0, size, part);
  }
}

std::string content(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// What is done with a mutant. Each returns the message of the error, or "accepted".

void use(const SlopeTables& tables) {
  const TabulatedSampler<double> sampler(std::make_shared<const SlopeTables>(tables));
  for (const double u : {0.0, 1e-9, 0.3, 0.7, 1.0}) {
    (void)sampler.sample({0.6, 0, 0.8}, {0.5, 0.2}, u, 1 - u);
    (void)sampler.pdf({0.6, 0, 0.8}, {0, 0.6, 0.8}, {0.5, 0.2});
  }
}

/// Reads the file, and once more what it holds with a right checksum of the content, without which
/// values that were changed go no further.
std::string load_pair(const fs::path& path, StoredTables (*read)(std::string_view)) {
  std::string message = "accepted";
  try {
    use(*io::load(path).tables);
    return message;
  } catch (const TableFileError& error) {
    message = error.what();
    if (message.find("'content_checksum'") == std::string::npos) return message;
  }
  try {
    const std::string bytes = content(path);
    StoredTables stored = read(without_trailer(bytes));
    stored.attributes["content_checksum"] = stored_checksum(stored);
    use(*from_stored(stored).tables);
    return "accepted";
  } catch (const FormatError& error) {
    return error.what();
  }
}

/// A copy that ends where memory cannot be read, so that one byte too much is a crash.
class Guarded {
 public:
  explicit Guarded(std::string_view bytes) : size_(bytes.size()) {
    const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
    const std::size_t room = (size_ + page - 1) / page * page;
    mapped_ = room + page;
    base_ = static_cast<char*>(
        mmap(nullptr, mapped_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0));
    REQUIRE(base_ != MAP_FAILED);
    begin_ = base_ + (room - size_) / kKernelAlignment * kKernelAlignment;
    std::memcpy(begin_, bytes.data(), size_);
    REQUIRE(mprotect(base_ + room, page, PROT_NONE) == 0);
  }
  ~Guarded() { munmap(base_, mapped_); }
  Guarded(const Guarded&) = delete;
  Guarded& operator=(const Guarded&) = delete;

  std::span<const std::byte> bytes() const {
    return {reinterpret_cast<const std::byte*>(begin_), size_};
  }

 private:
  std::size_t size_, mapped_;
  char *base_, *begin_;
};

void use(const KernelTables& tables) {
  const Kernel kernel = tables.kernel();
  (void)tables.text();
  for (const float z : {0.0f, 1e-20f, 0.5f, 1.0f})
    for (const float u : {0.0f, 1e-6f, 0.3f, 0.5f, 0.7f, 1.0f}) {
      const Vec3<float> wi{std::sqrt(1 - z * z), 0, z};
      for (const float alpha : {1e-4f, 0.3f, 10.0f})
        (void)kernel.sample_with_density(wi, {alpha, 0.2f}, u, 1 - u);
      (void)kernel.pdf(wi, {0, 0.6f, 0.8f}, {0.5f, 0.2f});
    }
}

std::string load_block(const fs::path& path) {
  try {
    use(vndf::load(path));
    const std::string bytes = content(path);
    use(KernelTables::view(Guarded(bytes).bytes()));
    return "accepted";
  } catch (const KernelTablesError& error) {
    return error.what();
  }
}

std::string with_block_checksum(std::string bytes) {
  constexpr std::size_t kPlace = offsetof(KernelHeader, checksum);
  if (bytes.size() < sizeof(KernelHeader)) return bytes;
  const std::uint64_t size = bytes.size();
  std::memcpy(bytes.data() + offsetof(KernelHeader, bytes), &size, sizeof size);
  const std::uint64_t sum = kernel_checksum(std::as_bytes(std::span(bytes)));
  std::memcpy(bytes.data() + kPlace, &sum, sizeof sum);
  return bytes;
}

/// A format: an honest file without checksum, how many of its bytes are structure, and what gives
/// it the checksum and reads it.
struct MutatedFormat {
  std::string name, honest;
  std::size_t structure;
  std::function<std::string(std::string)> seal;
  std::function<std::string(const fs::path&)> read;
};

std::vector<MutatedFormat> formats() {
  const StoredTables stored = to_stored(small_table_file());
  std::vector<MutatedFormat> formats{
      {"HDF5", write_hdf5(stored), std::string::npos, with_trailer,
       [](const fs::path& path) { return load_pair(path, read_hdf5); }},
      {"EXR", write_exr(stored), 6000, with_trailer,
       [](const fs::path& path) { return load_pair(path, read_exr); }}};
  for (const char* distribution : {"ggx", kMixture}) {
    const auto block = bake(*small_tables(distribution).tables, {.tolerance = 1e-3});
    const KernelTables tables = block.with_text({"a name", {{"ggx"}, "vndf build", "vndf 1", ""}});
    const auto* bytes = reinterpret_cast<const char*>(tables.bytes().data());
    formats.push_back({std::string("baked ") + distribution,
                       std::string(bytes, tables.bytes().size()), sizeof(KernelHeader),
                       with_block_checksum, load_block});
  }
  return formats;
}

/// A folder for the files, gone after the test.
struct ScratchFolder {
  fs::path path = fs::temp_directory_path() / ("vndf-mutants-" + std::to_string(getpid()));
  ScratchFolder() { fs::create_directory(path); }
  ~ScratchFolder() { fs::remove_all(path); }
};

/// The last part of a message, without names and numbers.
std::string kind_of(const std::string& message) {
  std::string kind;
  for (const char c :
       message.substr(message.rfind(": ") == std::string::npos ? 0 : message.rfind(": ") + 2))
    if (c < '0' || c > '9') kind += c;
  return kind.substr(0, kind.find(';'));
}

}  // namespace

TEST_CASE("mutants with right checksums are refused in a line or give tables to sample from") {
  const std::uint64_t count = from_environment("VNDF_TEST_MUTANTS", 3000);
  const std::uint64_t seed = from_environment("VNDF_TEST_SEED", 20140624);
  const ScratchFolder folder;
  for (const MutatedFormat& format : formats()) {
    Random random(seed);
    std::map<std::string, std::uint64_t> kinds;
    double slowest = 0;
    for (std::uint64_t k = 0; k < count; ++k) {
      std::string bytes = format.honest;
      mutate(bytes, format.structure, random);
      const fs::path path = folder.path / std::to_string(k);
      std::ofstream(path, std::ios::binary) << format.seal(std::move(bytes));
      const auto begin = std::chrono::steady_clock::now();
      const std::string message = [&] {
        const MemoryLimit limit(kMostBytes);
        return format.read(path);
      }();
      const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin;
      slowest = std::max(slowest, time.count());
      ++kinds[kind_of(message)];
      if (message.find('\n') != std::string::npos) FAIL(message);
      if (message.find('\x1b') != std::string::npos) FAIL(message);
      fs::remove(path);
    }
    std::string list;
    for (const auto& [kind, n] : kinds) list += std::to_string(n) + " " + kind + "\n";
    INFO(format.name << ", seed " << seed << ", slowest " << slowest << " s\n" << list);
    if (count > kMany) WARN(format.name << ", slowest " << slowest << " s\n" << list);
    if (count > kMany) CHECK(slowest < kMostSeconds);
    // Mutants must get past the first checks, and not all of them past the last.
    CHECK(kinds.size() > 10);
    CHECK(kinds["accepted"] > count / 100);
    CHECK(kinds["accepted"] < count / 2);
  }
}
