// Checks a block, and sums its bytes.
#include "vndf/kernel_block.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <string>
#include <string_view>

#include "vndf/provenance.h"
#include "vndf/surface_slopes.h"

namespace vndf {
namespace {

static_assert(std::endian::native == std::endian::little, "blocks are read as they lie in files");

constexpr std::size_t kChecksumBegin = offsetof(KernelHeader, checksum);
constexpr std::size_t kPatchBytes = 64, kCubicBytes = 16, kGuideBytes = 8;

[[noreturn]] void fail(const std::string& rule) {
  throw KernelTablesError(rule + "; bake the tables again");
}

void require(bool holds, const char* rule) {
  if (!holds) fail(rule);
}

/// A block that is not trusted yet.
class Checker {
 public:
  explicit Checker(std::span<const std::byte> bytes) : bytes_(bytes) {}

  void check() const {
    check_frame();
    check_numbers();
    check_sampling();
    std::size_t entries = 0;
    for (const kernel::VndfCurve& curve : {header().ndf, header().backfacing})
      check_curve(curve, entries);
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
    require(h.bytes == bytes_.size() && h.bytes <= kKernelMostBytes,
            "the bytes are fewer or more than the header says");
    require(h.sampling_bytes <= h.bytes && h.below_bytes <= h.bytes - h.sampling_bytes,
            "more bytes for sampling than there are");
    require(h.checksum == kernel_checksum(bytes_),
            "the checksum does not match: bytes were changed");
    check_text();
  }

  /// The samples and after them the texts are the end of the block.
  void check_text() const {
    const KernelHeader& h = header();
    const std::size_t samples_end = h.samples + std::size_t{h.sample_count} * kKernelSampleBytes;
    require(h.samples >= sizeof(KernelHeader) && h.samples % sizeof(double) == 0 &&
                h.sample_count <= kMaxSamples && samples_end == h.text &&
                samples_end + h.text_bytes == bytes_.size(),
            "the samples and texts are not the end of the block");
    require(h.text_bytes == 0 || bytes_.back() == std::byte{0}, "a text has no end");
    const std::string_view texts(reinterpret_cast<const char*>(bytes_.data()) + h.text,
                                 h.text_bytes);
    require(!has_control_character(texts), "a text has a control character");
    for (std::size_t at = h.samples; at < samples_end; at += sizeof(double))
      require(std::isfinite(double_at(bytes_, at)), "a sample is not a finite number");
    const auto surface = text_at(bytes_, kKernelSurfaceText);
    require(!surface || surface_slopes_of(*surface), "the surface of the map breaks a rule");
  }

  void check_numbers() const {
    const KernelHeader& h = header();
    // Then no product of it with a stretched direction overflows or vanishes (kVndfLongest), and
    // the place of a direction is a number.
    require(h.unit >= 0x1p-80f && h.unit <= 0x1p80f, "the unit of slopes is not a moderate number");
    require(h.scale_root >= 0 && h.scale_constant >= 0 && h.rim >= 0 &&
                std::isfinite(h.scale_root + h.scale_constant + h.rim) &&
                h.scale_root + h.scale_constant + h.rim > 0,
            "the scale of slope y is not a finite number > 0");
    require(h.least_root > 0 && h.least_root < h.most_root && h.most_root < 1,
            "the bounds of the root of sigma are not inside (0, 1)");
    require(h.direction_offset > 0 && h.direction_offset < 1,
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
    require_keys(h.direction, key(h.direction_offset, h.direction),
                 key(1 + h.direction_offset, h.direction));
    check_first_columns(h.marginal, low, high);
    check_second_columns(h.conditional, low, high);
    require(h.marginal.shift == h.conditional.shift, "the columns of the tables differ in shift");
    const std::size_t patch = h.separable != 0 ? kCubicBytes : kPatchBytes;
    std::size_t row = 0;
    if (h.separable == 0) {
      row = check_slopes();
    }
    require_inside(largest_offset(h.marginal) + largest_offset(h.direction) + kPatchBytes);
    require_inside(largest_offset(h.conditional) + row + patch);
    if (h.below_bytes != 0)
      check_below(low, high);
    else
      require(h.below_most_cotangent == 0, "directions below the horizon have no patches");
  }

  /// What directions below the horizon have of their own.
  void check_below(float low, float high) const {
    const KernelHeader& h = header();
    const float most = 1 + h.direction_offset;
    require(h.below_most_cotangent > 0 && h.below_least_place > 0 && h.below_least_place < most,
            "the axis of directions below the horizon has no length");
    require_keys(h.below_direction, key(h.below_least_place, h.below_direction),
                 key(most, h.below_direction));
    require(h.below_marginal.shift == h.marginal.shift,
            "the columns of the tables differ in shift");
    check_first_columns(h.below_marginal, low, high);
    require_inside(largest_offset(h.below_marginal) + largest_offset(h.below_direction) +
                   kPatchBytes);
    if (h.separable != 0) return;
    require(h.below_conditional.shift == h.marginal.shift,
            "the columns of the tables differ in shift");
    check_second_columns(h.below_conditional, low, high);
    require(h.below_slope_most >= h.slope_offset && h.below_slope_most < 1,
            "the axis of rows of y has no length");
    require_keys(h.below_slope, key(h.slope_offset, h.below_slope),
                 key(h.below_slope_most, h.below_slope));
    require_inside(largest_offset(h.below_conditional) + largest_offset(h.below_slope) +
                   kPatchBytes);
  }

  void check_first_columns(const KernelAxis& axis, float low, float high) const {
    const std::uint32_t upper = header().column_upper - kernel::kVndfSign;
    require_apart(upper);
    require_keys(axis, key(low, axis), key(high, axis));
    require_keys(axis, key(raised(low, upper), axis), key(raised(high, upper), axis));
  }

  void check_second_columns(const KernelAxis& axis, float low, float high) const {
    const KernelHeader& h = header();
    if (h.separable != 0) return require_keys(axis, key(low, axis), key(high, axis));
    const float middle = h.column_span / 2;
    require(middle > low && middle < high, "the middle of the columns is not between their ends");
    require(h.column_span - high >= low, "the mirror of a column is before the first");
    require_apart(h.column_mirror);
    for (const std::uint32_t mirrored : {0u, h.column_mirror})
      require_keys(axis, key(raised(low, mirrored), axis), key(raised(middle, mirrored), axis));
  }

  /// `added` must make a place some power of two larger when it is added to its bits.
  static void require_apart(std::uint32_t added) {
    require((added & 0x7fffff) == 0 && added >= 0x800000 && added <= 0x20000000,
            "the halves of an axis are not a power of two apart");
  }

  /// Checks the map and the rows of y. Returns the largest distance of a row from the first.
  std::size_t check_slopes() const {
    const KernelHeader& h = header();
    require(h.slope_middle > 0 && h.slope_middle < 1, "the middle of the slopes is not in (0, 1)");
    require(h.slope_offset > 0 && h.slope_offset < h.slope_most && h.slope_most < 1,
            "the axis of slopes has no length");
    require_apart(h.slope_upper);
    KernelAxis pairs = h.slope;  // as an axis with twice the entries
    require(pairs.count <= kKernelMostBytes / (2 * kGuideBytes), "a guide does not cover its axis");
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

  /// The place with `bits` added to its bits.
  static float raised(float place, std::uint32_t bits) {
    return std::bit_cast<float>(std::bit_cast<std::uint32_t>(place) + bits);
  }

  /// Counts the entries of the guides in `entries`. No two segments share one, so that they are not
  /// more than the block holds, and none is looked at again and again.
  void check_curve(const kernel::VndfCurve& curve, std::size_t& entries) const {
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
      entries += s.count;
      require(entries <= bytes_.size() / kGuideBytes, "segments of curves share their guides");
      const KernelAxis axis{s.guide + (s.first_key << 3), s.first_key, s.count, s.shift};
      require_keys(axis, key(s.offset, axis), key((s.end - s.begin) + s.offset, axis));
      require_inside(largest_offset(axis) + kCubicBytes);
    }
  }

  static std::uint32_t key(float place, const KernelAxis& axis) {
    require(axis.shift < 32, "an axis is shifted by more than a number has bits");
    return std::bit_cast<std::uint32_t>(place) >> axis.shift;
  }

  /// The keys from `first` to `last`, which is not less, must have entries inside the block.
  void require_keys(const KernelAxis& axis, std::uint32_t first, std::uint32_t last) const {
    require(axis.guide % kGuideBytes == 0, "a guide is not aligned");
    require(first >= axis.first_key && axis.count <= kKernelMostBytes &&
                last - axis.first_key < axis.count,
            "a guide does not cover its axis");
    require_inside(axis.guide + axis.count * kGuideBytes);
  }

  /// The largest distance in the entries of a guide, which is inside the block.
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

double double_at(std::span<const std::byte> bytes, std::size_t at) {
  double value;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

std::optional<std::string_view> text_at(std::span<const std::byte> block, std::size_t k) {
  const auto& header = *reinterpret_cast<const KernelHeader*>(block.data());
  std::string_view rest(reinterpret_cast<const char*>(block.data()) + header.text,
                        header.text_bytes);
  for (; !rest.empty(); --k) {
    const std::string_view text = rest.substr(0, rest.find('\0'));
    if (k == 0) return text;
    rest.remove_prefix(text.size() + 1);
  }
  return {};
}

void check_block(std::span<const std::byte> bytes) {
  Checker(bytes).check();
}

}  // namespace vndf
