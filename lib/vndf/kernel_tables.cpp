// Reading and checking the block of a kernel.
#include "vndf/kernel_tables.h"

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <new>
#include <random>
#include <string_view>
#include <utility>
#include <vector>

namespace vndf {
namespace {

static_assert(std::endian::native == std::endian::little, "blocks are read as they lie in files");

constexpr std::size_t kChecksumBegin = offsetof(KernelHeader, checksum);
constexpr std::size_t kSampleBytes = 16, kPatchBytes = 64, kCubicBytes = 16, kGuideBytes = 8;
constexpr std::size_t kMostBytes = 1u << 30;

[[noreturn]] void fail(const std::string& rule) {
  throw KernelTablesError(rule + "; bake the tables again");
}

void require(bool holds, const char* rule) {
  if (!holds) fail(rule);
}

double double_at(std::span<const std::byte> bytes, std::size_t at) {
  double value;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

/// A block that is not trusted yet.
class Checker {
 public:
  explicit Checker(std::span<const std::byte> bytes) : bytes_(bytes) {}

  void check() const {
    check_frame();
    check_numbers();
    check_sampling();
    check_curve(header().ndf);
    check_curve(header().backfacing);
  }

  const KernelHeader& header() const {
    return *reinterpret_cast<const KernelHeader*>(bytes_.data());
  }

 private:
  void check_frame() const {
    require(bytes_.size() >= sizeof(KernelHeader), "shorter than the header of baked tables");
    require(reinterpret_cast<std::uintptr_t>(bytes_.data()) % kKernelAlignment == 0,
            "baked tables must begin at a multiple of 64 bytes");
    const KernelHeader& h = header();
    require(std::string_view(h.magic, 8) == kKernelMagic, "not a file of baked tables");
    if (h.version != kKernelVersion)
      fail("baked tables of version " + std::to_string(h.version) + ", this program reads " +
           std::to_string(kKernelVersion));
    require(h.header_bytes == sizeof(KernelHeader), "a header of another size");
    require(h.bytes == bytes_.size() && h.bytes <= kMostBytes,
            "the bytes are fewer or more than the header says");
    require(h.checksum == kernel_checksum(bytes_),
            "the checksum does not match: bytes were changed");
    check_text();
  }

  /// The samples and after them the texts are the end of the block.
  void check_text() const {
    const KernelHeader& h = header();
    const std::size_t samples_end = h.samples + std::size_t{h.sample_count} * kSampleBytes;
    require(h.samples >= sizeof(KernelHeader) && h.samples % sizeof(double) == 0 &&
                h.sample_count <= kMaxSamples && samples_end == h.text &&
                samples_end + h.text_bytes == bytes_.size(),
            "the samples and texts are not the end of the block");
    require(h.text_bytes == 0 || bytes_.back() == std::byte{0}, "a text has no end");
    for (std::size_t at = h.samples; at < samples_end; at += sizeof(double))
      require(std::isfinite(double_at(bytes_, at)), "a sample is not a finite number");
  }

  void check_numbers() const {
    const KernelHeader& h = header();
    require(positive(h.unit), "the unit of slopes is not a finite number > 0");
    require(h.scale_root >= 0 && h.scale_constant >= 0 && h.rim >= 0 &&
                std::isfinite(h.scale_root + h.scale_constant + h.rim) &&
                h.scale_root + h.scale_constant + h.rim > 0,
            "the scale of slope y is not a finite number > 0");
    require(h.least_root > 0 && h.least_root < h.most_root && h.most_root < 1,
            "the bounds of the root of sigma are not inside (0, 1)");
    require(positive(h.direction_offset) && h.direction_offset < 1,
            "the offset of an axis is not inside (0, 1)");
    require(h.column_roots <= 1 && h.separable <= 1, "a choice that is neither 0 nor 1");
    require(h.column_roots == 0 || (h.column_offset > 0 && h.column_offset < 1),
            "the offset of the columns is not inside (0, 1)");
  }

  void check_sampling() const {
    const KernelHeader& h = header();
    // The root of twice the least u is 2^-12.
    const float low = h.column_roots != 0 ? h.column_offset + 0x1p-12f : kernel::kVndfLeastU;
    const float high = h.column_roots != 0 ? 1 + h.column_offset : 0.5f;
    const std::uint32_t upper = h.column_upper - kernel::kVndfSign;
    require_apart(upper);
    require_keys(h.direction, key(h.direction_offset, h.direction),
                 key(1 + h.direction_offset, h.direction));
    require_keys(h.marginal, key(low, h.marginal), key(high, h.marginal));
    require_keys(h.marginal, key(raised(low, upper), h.marginal),
                 key(raised(high, upper), h.marginal));
    check_second_columns(low, high);
    require(h.marginal.shift == h.conditional.shift, "the columns of the tables differ in shift");
    const std::size_t patch = h.separable != 0 ? kCubicBytes : kPatchBytes;
    std::size_t row = 0;
    if (h.separable == 0) {
      row = check_slopes();
    }
    require_inside(largest_offset(h.marginal) + largest_offset(h.direction) + kPatchBytes);
    require_inside(largest_offset(h.conditional) + row + patch);
  }

  void check_second_columns(float low, float high) const {
    const KernelHeader& h = header();
    if (h.separable != 0)
      return require_keys(h.conditional, key(low, h.conditional), key(high, h.conditional));
    const float middle = h.column_span / 2;
    require(middle > low && middle < high, "the middle of the columns is not between their ends");
    require(h.column_span - high >= low, "the mirror of a column is before the first");
    require_apart(h.column_mirror);
    for (const std::uint32_t mirrored : {0u, h.column_mirror})
      require_keys(h.conditional, key(raised(low, mirrored), h.conditional),
                   key(raised(middle, mirrored), h.conditional));
  }

  /// What is added to the bits of a place to make it some power of two larger.
  static void require_apart(std::uint32_t added) {
    require((added & 0x7fffff) == 0 && added >= 0x800000 && added <= 0x20000000,
            "the halves of an axis are not a power of two apart");
  }

  /// The largest distance of a row of patches from the first.
  std::size_t check_slopes() const {
    const KernelHeader& h = header();
    require(h.slope_middle > 0 && h.slope_middle < 1, "the middle of the slopes is not in (0, 1)");
    require(positive(h.slope_offset) && positive(h.slope_most) && h.slope_offset < h.slope_most &&
                h.slope_most < 1,
            "the axis of slopes has no length");
    require(
        (h.slope_upper & 0x7fffff) == 0 && h.slope_upper >= 0x800000 && h.slope_upper <= 0x20000000,
        "the halves of the slopes are not a power of two apart");
    KernelAxis pairs = h.slope;  // as an axis with twice the entries
    require(pairs.count <= kMostBytes / (2 * kGuideBytes), "a guide does not cover its axis");
    for (const std::uint32_t half : {0u, h.slope_upper})
      require_keys(h.slope, key(raised(h.slope_offset, half), h.slope),
                   key(raised(h.slope_most, half), h.slope));
    pairs.count *= 2;
    require_inside(std::size_t{pairs.guide} + std::size_t{pairs.count} * kGuideBytes);
    std::size_t map = 0, row = 0;
    for (std::uint32_t k = 0; k < pairs.count; ++k) {
      const std::size_t offset = offset_at(pairs, k);
      (k % 2 == 0 ? map : row) = std::max(k % 2 == 0 ? map : row, offset);
    }
    require_inside(map + kCubicBytes);
    return row;
  }

  /// A place with `bits` added to it.
  static float raised(float place, std::uint32_t bits) {
    return std::bit_cast<float>(std::bit_cast<std::uint32_t>(place) + bits);
  }

  void check_curve(const kernel::VndfCurve& curve) const {
    require(curve.count >= 1 && curve.count <= 4096 && curve.segments % 16 == 0,
            "a curve has no segments");
    require_inside(curve.segments + std::size_t{curve.count} * sizeof(KernelSegment));
    float end = 0;
    for (std::uint32_t k = 0; k < curve.count; ++k) {
      KernelSegment s;
      std::memcpy(&s, bytes_.data() + curve.segments + k * sizeof s, sizeof s);
      require(
          s.begin >= end && s.end > s.begin && std::isfinite(s.end) && s.offset > 0 && s.offset < 1,
          "a segment of a curve has no length");
      end = s.end;
      const KernelAxis axis{s.guide + (s.first_key << 3), s.first_key, s.count, s.shift};
      require_keys(axis, key(s.offset, axis), key((s.end - s.begin) + s.offset, axis));
      require_inside(largest_offset(axis) + kCubicBytes);
    }
  }

  static bool positive(float x) { return x > 0 && std::isfinite(x); }

  static std::uint32_t key(float place, const KernelAxis& axis) {
    require(axis.shift < 32, "an axis is shifted by more than a number has bits");
    return std::bit_cast<std::uint32_t>(place) >> axis.shift;
  }

  void require_keys(const KernelAxis& axis, std::uint32_t first, std::uint32_t last) const {
    require(axis.guide % kGuideBytes == 0, "a guide is not aligned");
    require(first <= last && first >= axis.first_key && axis.count <= kMostBytes &&
                last - axis.first_key < axis.count,
            "a guide does not cover its axis");
    require_inside(axis.guide + axis.count * kGuideBytes);
  }

  /// Of the entries of a guide that is inside the block.
  std::size_t largest_offset(const KernelAxis& axis) const {
    std::size_t largest = 0;
    for (std::uint32_t k = 0; k < axis.count; ++k) largest = std::max(largest, offset_at(axis, k));
    return largest;
  }

  std::size_t offset_at(const KernelAxis& axis, std::size_t k) const {
    kernel::Guide entry;
    std::memcpy(&entry, bytes_.data() + axis.guide + k * kGuideBytes, sizeof entry);
    require(std::isfinite(entry.start) && entry.offset % kCubicBytes == 0,
            "an entry of a guide is no place or not aligned");
    return entry.offset;
  }

  void require_inside(std::size_t end) const {
    require(end <= bytes_.size(), "coefficients are outside the block");
  }

  std::span<const std::byte> bytes_;
};

struct AlignedDelete {
  void operator()(const std::byte* p) const {
    ::operator delete (const_cast<std::byte*>(p), std::align_val_t{kKernelAlignment});
  }
};

std::shared_ptr<std::byte> aligned_bytes(std::size_t count) {
  auto* p = static_cast<std::byte*>(::operator new (count, std::align_val_t{kKernelAlignment}));
  return {p, AlignedDelete()};
}

/// A block and who frees it.
struct OwnedBlock {
  std::shared_ptr<const std::byte> owner;
  std::span<const std::byte> bytes;
};

/// A block of the bytes `begin` and then `end`, with a header that `change` has changed and the
/// checksum that belongs to it.
template <class Change>
OwnedBlock changed_copy(std::span<const std::byte> begin, std::string_view end, Change change) {
  const std::size_t size = begin.size() + end.size();
  const auto owner = aligned_bytes(size);
  const std::span<std::byte> own(owner.get(), size);
  std::ranges::copy(begin, own.begin());
  std::ranges::copy(std::as_bytes(std::span(end)), own.subspan(begin.size()).begin());
  auto* header = reinterpret_cast<KernelHeader*>(own.data());
  change(*header);
  header->checksum = kernel_checksum(own);
  return {owner, own};
}

/// The leading digits of a small number.
std::string digits_of(double number) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.3g", number);
  return text.data();
}

/// The error that names the file at `path`.
KernelTablesError error_in(const std::filesystem::path& path, const std::string& rule) {
  return KernelTablesError(path.string() + ": " + rule);
}

/// The bytes of the file at `path`.
std::vector<char> bytes_of(const std::filesystem::path& path) {
  std::error_code error;
  const auto size = std::filesystem::file_size(path, error);
  if (error)
    throw error_in(path, "cannot be read (" + error.message() + "); give a file of baked tables");
  if (size > kMostBytes)
    throw error_in(path, "too large for baked tables; give a file of baked tables");
  std::vector<char> bytes(size);
  std::ifstream file(path, std::ios::binary);
  if (!file.read(bytes.data(), static_cast<std::streamsize>(size)))
    throw error_in(path, "cannot be read; give a file of baked tables");
  return bytes;
}

/// The texts in their order in a block, each of which `text` keeps.
template <class Text>
auto parts_of(Text& text) {
  auto& p = text.provenance;
  return std::array{&text.distribution, &p.specification.text, &p.command, &p.program, &p.notes};
}

void require_storable(const KernelText& text) {
  auto broken = check_text("distribution", text.distribution);
  if (!broken) broken = check(text.provenance);
  if (broken) throw KernelTablesError(*broken + "; shorten or correct it");
}

std::string sample_bytes(const Specification& specification) {
  std::string bytes;
  for (std::size_t i = 0; i < specification.r.size(); ++i)
    for (const double value : {specification.r[i], specification.p22[i]})
      bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  return bytes;
}

std::string text_bytes(const KernelText& text) {
  std::string bytes;
  for (const std::string* part : parts_of(text)) bytes.append(*part).push_back('\0');
  return bytes;
}

}  // namespace

std::uint64_t kernel_checksum(std::span<const std::byte> block) {
  constexpr std::uint64_t kOdd = 0x9E3779B97F4A7C15;
  constexpr std::size_t kLanes = 4, kWord = sizeof(std::uint64_t);
  std::array<std::uint64_t, kLanes> lanes{1, 2, 3, 4};
  const std::size_t words = block.size() / kWord;
  const auto add = [&](std::size_t k, std::uint64_t word) {
    const std::uint64_t mixed = (lanes[k % kLanes] ^ word) * kOdd;
    lanes[k % kLanes] = mixed ^ (mixed >> 29);
  };
  const auto word_at = [&](std::size_t k) {
    std::uint64_t word;
    std::memcpy(&word, block.data() + k * kWord, kWord);
    return word;
  };
  static_assert(kChecksumBegin % kWord == 0 && kChecksumBegin / kWord < kLanes);
  for (std::size_t k = 0; k < std::min(words, kLanes); ++k)
    add(k, k == kChecksumBegin / kWord ? 0 : word_at(k));
  std::size_t k = kLanes;
  for (; k + kLanes <= words; k += kLanes)
    for (std::size_t lane = 0; lane < kLanes; ++lane) add(lane, word_at(k + lane));
  for (; k < words; ++k) add(k, word_at(k));
  for (std::size_t i = words * kWord; i < block.size(); ++i)
    add(i, std::to_integer<std::uint64_t>(block[i]));
  std::uint64_t sum = block.size();
  for (const std::uint64_t lane : lanes) sum = (sum ^ lane) * kOdd;
  return sum ^ (sum >> 32);
}

KernelTables KernelTables::view(std::span<const std::byte> bytes) {
  Checker(bytes).check();
  return {nullptr, bytes};
}

KernelTables KernelTables::copy(std::span<const std::byte> bytes) {
  const auto owner = aligned_bytes(std::max<std::size_t>(bytes.size(), 1));
  std::copy(bytes.begin(), bytes.end(), owner.get());
  const std::span<const std::byte> own(owner.get(), bytes.size());
  Checker(own).check();
  return {owner, own};
}

const KernelHeader& KernelTables::header() const {
  return *reinterpret_cast<const KernelHeader*>(bytes_.data());
}

Certificate KernelTables::certificate() const {
  Certificate certificate;
  std::size_t k = 0;
  for_each_figure(certificate,
                  [&](const std::string&, double& figure) { figure = header().certificate[k++]; });
  return certificate;
}

KernelText KernelTables::text() const {
  const char* at = reinterpret_cast<const char*>(bytes_.data()) + header().text;
  const char* end = at + header().text_bytes;
  KernelText text;
  for (std::string* part : parts_of(text)) {
    const char* zero = std::find(at, end, '\0');
    part->assign(at, zero);
    at = zero == end ? end : zero + 1;
  }
  Specification& specification = text.provenance.specification;
  for (std::size_t i = 0; i < header().sample_count; ++i) {
    const std::size_t place = header().samples + i * kSampleBytes;
    specification.r.push_back(double_at(bytes_, place));
    specification.p22.push_back(double_at(bytes_, place + sizeof(double)));
  }
  return text;
}

Kernel KernelTables::kernel() const {
  const KernelHeader& h = header();
  const auto guide = [](const KernelAxis& axis) { return axis.guide - (axis.first_key << 3); };
  kernel::VndfTables t;
  t.unit = h.unit;
  t.scale_root = h.scale_root;
  t.scale_constant = h.scale_constant;
  t.rim = h.rim;
  t.least_root = h.least_root;
  t.most_root = h.most_root;
  t.direction_offset = h.direction_offset;
  t.slope_middle = h.slope_middle;
  t.slope_offset = h.slope_offset;
  t.slope_most = h.slope_most;
  t.direction_guide = guide(h.direction);
  t.direction_shift = h.direction.shift;
  t.column_shift = h.marginal.shift;
  t.column_upper = h.column_upper;
  t.column_roots = h.column_roots;
  t.column_offset = h.column_offset;
  t.column_span = h.column_span;
  t.column_mirror = h.column_mirror;
  t.marginal_guide = guide(h.marginal);
  t.conditional_guide = guide(h.conditional);
  t.slope_guide = h.slope.guide - (h.slope.first_key << 4);
  t.slope_upper = h.slope_upper;
  t.slope_shift = h.slope.shift;
  t.separable = h.separable;
  const bool plain = h.separable != 0 && h.rim == 0 && h.column_roots == 0;
  t.kind = plain ? kernel::kVndfPlain : kernel::kVndfAny;
  t.ndf = h.ndf;
  t.backfacing = h.backfacing;
  t.block.bytes = reinterpret_cast<const unsigned char*>(bytes_.data());
  return Kernel(t);
}

KernelTables KernelTables::with_text(const KernelText& text) const {
  require_storable(text);
  const std::string samples = sample_bytes(text.provenance.specification);
  const std::string end = samples + text_bytes(text);
  const OwnedBlock block = changed_copy(bytes_.first(header().samples), end, [&](KernelHeader& h) {
    h.sample_count = static_cast<std::uint32_t>(samples.size() / kSampleBytes);
    h.text = h.samples + static_cast<std::uint32_t>(samples.size());
    h.text_bytes = static_cast<std::uint32_t>(end.size() - samples.size());
    h.bytes = h.samples + end.size();
  });
  return {block.owner, block.bytes};
}

KernelTables KernelTables::with_certificate(const Certificate& certificate, bool measured) const {
  const OwnedBlock block = changed_copy(bytes_, {}, [&](KernelHeader& h) {
    h.certified = measured ? 1 : 0;
    std::size_t k = 0;
    for_each_figure(certificate,
                    [&](const std::string&, double figure) { h.certificate[k++] = figure; });
  });
  return {block.owner, block.bytes};
}

KernelTables KernelTables::with_differences(double x, double y) const {
  const OwnedBlock block = changed_copy(bytes_, {}, [&](KernelHeader& h) {
    h.difference_x = x;
    h.difference_y = y;
  });
  return {block.owner, block.bytes};
}

void save(const std::filesystem::path& path, const KernelTables& tables) {
  // Under another name in the same folder first, for a rename replaces a file at once or not at
  // all.
  std::random_device random;
  const std::filesystem::path temporary = path.string() + "." + std::to_string(random()) + ".tmp";
  const auto fail_with = [&](const std::string& why) {
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    throw error_in(
        path, "cannot be written (" + why + "); give a name in a folder that can be written to");
  };
  std::ofstream file(temporary, std::ios::binary);
  const auto bytes = tables.bytes();
  file.write(reinterpret_cast<const char*>(bytes.data()),
             static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) fail_with(std::strerror(errno));
  std::error_code error;
  std::filesystem::rename(temporary, path, error);
  if (error) fail_with(error.message());
}

bool is_kernel_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  char magic[8] = {};
  return file.read(magic, sizeof magic) && std::string_view(magic, 8) == kKernelMagic;
}

KernelTables load(const std::filesystem::path& path, const LoadOptions& options) {
  const std::vector<char> bytes = bytes_of(path);
  const auto tables = [&] {
    try {
      return KernelTables::copy(std::as_bytes(std::span(bytes)));
    } catch (const KernelTablesError& e) {
      throw error_in(path, e.what());
    }
  }();
  const Certificate c = tables.certificate();
  const double u_error = std::max(c.marginal.max_u_error, c.conditional.max_u_error);
  if (!(u_error <= options.max_u_error))
    throw error_in(path, "its certificate admits a u-error of " + digits_of(u_error) + ", above " +
                             digits_of(options.max_u_error) +
                             "; bake it with a smaller --tolerance");
  return tables;
}

}  // namespace vndf
