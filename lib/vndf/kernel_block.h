// The layout of a block of baked tables, and its check. A block is one contiguous piece of plain
// little-endian data, header, guides, patches and curves, with distances in place of addresses, so
// that the bytes of a file are the tables. tables/FORMAT.md describes it for readers in any
// language. Bytes may come from anywhere: after check_block() sampling reads nothing outside them,
// and its normals are of unit length and their sampled densities finite, whatever the coefficients
// are. D, Lambda, G1 and the density of the exact distribution are then not negative, but of a
// block that nobody baked they may be infinite or no number.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <string_view>

#include "vndf/kernel.h"

namespace vndf {

/// Thrown where bytes are not the tables of a kernel, or not good enough. The message says which
/// rule they break and what to do.
class KernelTablesError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// An axis of cells: the guide at byte `guide` has `count` entries, and the key of a place, the
/// bits of the positive float above `shift`, less `first_key` is the index of its entry.
struct KernelAxis {
  std::uint32_t guide, first_key, count, shift;
};

/// A segment of a curve over slopes from `begin` to `end`; its places are x - begin + offset.
/// `guide` is that of an axis less eight times its first key, because that is what the kernel adds
/// keys to.
struct KernelSegment {
  float begin;
  std::uint32_t guide;
  float end;
  std::uint32_t shift;
  float offset;
  std::uint32_t first_key, count, reserved;
};

/// The first bytes of a block. The names of kernel::VndfTables have the meaning that they have
/// there; `guide` and the like are bytes from the first of the block.
struct KernelHeader {
  char magic[8];                 ///< kKernelMagic
  std::uint32_t version;         ///< kKernelVersion
  std::uint32_t header_bytes;    ///< sizeof(KernelHeader)
  std::uint64_t bytes;           ///< of the whole block
  std::uint64_t checksum;        ///< kernel_checksum() of all bytes but these eight
  std::uint64_t sampling_bytes;  ///< of the guides and patches, which sampling reads
  std::uint64_t below_bytes;     ///< of those for directions below the horizon; 0 if there are none
  KernelAxis direction, marginal, conditional;
  KernelAxis slope;  ///< its guide has two entries for each key, of the map and of rows of y
  /// For directions below the horizon; the last two where tables are not separable.
  KernelAxis below_direction, below_marginal, below_conditional, below_slope;
  float unit, scale_root, scale_constant, rim;
  float least_root, most_root, direction_offset, slope_middle, slope_offset, slope_most,
      column_offset, column_span, below_most_cotangent, below_least_place, below_slope_most;
  std::uint32_t column_upper, column_mirror, column_roots, slope_upper, separable, reserved;
  kernel::VndfCurve ndf, backfacing;
  std::uint32_t text, text_bytes;       ///< text_at(), each with a 0 after it
  std::uint32_t certified;              ///< 1 where the certificate was measured of the kernel
  std::uint32_t samples, sample_count;  ///< of the specification, two float64 each: radius, density
  double tolerance;                     ///< for which it was baked, in u
  double difference_x, difference_y;    ///< largest differences in u from the pair
  std::array<double, 36> certificate;
};
static_assert(sizeof(KernelHeader) % 16 == 0);

inline constexpr char kKernelMagic[] = "vndfkern";
inline constexpr std::uint32_t kKernelVersion = 3;
/// Blocks begin at a multiple of it.
inline constexpr std::size_t kKernelAlignment = 64;
/// Most bytes of a block.
inline constexpr std::size_t kKernelMostBytes = 1u << 30;
/// Bytes of one sample of a specification.
inline constexpr std::size_t kKernelSampleBytes = 2 * sizeof(double);

/// A sum over all bytes of a block but those of the checksum itself. It finds accidents and not
/// forgery, and works on four products of 64 bits side by side, so that a block is checked about as
/// fast as memory is read.
std::uint64_t kernel_checksum(std::span<const std::byte> block);

/// The number at byte `at` of a block.
double double_at(std::span<const std::byte> block, std::size_t at);

/// The texts of a block one after the other: the five of KernelText, and where the tables are of a
/// map the text of its surface (surface_slopes.h).
inline constexpr std::size_t kKernelSurfaceText = 5;

/// The k-th text of a checked block from 0, or nothing where it has fewer.
std::optional<std::string_view> text_at(std::span<const std::byte> block, std::size_t k);

/// Throws KernelTablesError unless `bytes` are a block: everything that sampling will read is
/// inside them and the checksum is right. Allocates nothing unless it throws.
void check_block(std::span<const std::byte> bytes);

}  // namespace vndf
