// The block that a Kernel samples from: header, guides, patches and curves, one contiguous piece of
// plain little-endian data that holds distances in place of addresses, so that the bytes of a file
// are the tables. tables/FORMAT.md describes it for readers in any language.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>

#include "vndf/certificate.h"
#include "vndf/kernel.h"
#include "vndf/provenance.h"

namespace vndf {

/// Why bytes are not the tables of a kernel, or not good enough: the rule and what to do.
class KernelTablesError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// An axis: leading bits of a positive float, those above `shift`, less `first_key`, are the index
/// into `count` entries of a guide at `guide`.
struct KernelAxis {
  std::uint32_t guide, first_key, count, shift;
};

/// A segment of a curve: places x - begin + offset for x in [begin, end]. `guide` is that of the
/// axis less eight times its first key, as the kernel adds it.
struct KernelSegment {
  float begin;
  std::uint32_t guide;
  float end;
  std::uint32_t shift;
  float offset;
  std::uint32_t first_key, count, reserved;
};

/// The first bytes of a block.
struct KernelHeader {
  char magic[8];                 ///< kKernelMagic
  std::uint32_t version;         ///< kKernelVersion
  std::uint32_t header_bytes;    ///< sizeof(KernelHeader)
  std::uint64_t bytes;           ///< of the whole block
  std::uint64_t checksum;        ///< kernel_checksum() of all bytes but these eight
  std::uint64_t sampling_bytes;  ///< of the guides and patches, which sampling reads
  KernelAxis direction, marginal, conditional;
  KernelAxis slope;  ///< its guide has two entries for each key
  float unit, scale_root, scale_constant, rim;
  float least_root, most_root, direction_offset, slope_middle, slope_offset, slope_most,
      column_offset, column_span;
  std::uint32_t column_upper, column_mirror, column_roots, slope_upper, separable;
  kernel::VndfCurve ndf, backfacing;
  std::uint32_t text,
      text_bytes;  ///< the texts of KernelText in their order, each with a 0 after it
  std::uint32_t
      certified;  ///< 1 where the certificate was measured against the distribution itself
  std::uint32_t samples, sample_count;  ///< of the specification, two float64 each: radius, density
  double tolerance;                     ///< that it was baked for
  double difference_x, difference_y;    ///< largest differences in u from the pair
  std::array<double, 25> certificate;
};
static_assert(sizeof(KernelHeader) % 16 == 0);

inline constexpr char kKernelMagic[] = "vndfkern";
inline constexpr std::uint32_t kKernelVersion = 2;
/// Blocks begin at a multiple of it.
inline constexpr std::size_t kKernelAlignment = 64;

/// What a block says of itself beside the numbers. Sampling does not read it.
struct KernelText {
  std::string distribution = {};  ///< name, for people
  Provenance provenance = {};
};

/// A sum over all bytes but those of the checksum itself, which finds accidents, not forgery: four
/// products of 64 bits side by side, so that a block is checked at the speed of memory.
std::uint64_t kernel_checksum(std::span<const std::byte> block);

/// Immutable tables, shared by copies.
class KernelTables {
 public:
  /// The tables in `bytes`, which are not copied, must begin at a multiple of kKernelAlignment and
  /// outlive all kernels. Allocates nothing. Throws KernelTablesError unless everything that
  /// sampling will read is inside them and the checksum is right.
  static KernelTables view(std::span<const std::byte> bytes);

  /// The same for a copy that the tables own.
  static KernelTables copy(std::span<const std::byte> bytes);

  std::span<const std::byte> bytes() const { return bytes_; }
  const KernelHeader& header() const;
  /// Bytes that sampling may read.
  std::size_t sampling_bytes() const { return header().sampling_bytes; }
  Certificate certificate() const;
  KernelText text() const;

  /// The sampler. It refers to the bytes and does not own them.
  Kernel kernel() const;

  /// Return the same tables with something else about them: a certificate, and whether it was
  /// measured against the distribution itself; the largest differences from their pair; a text.
  /// with_text() throws KernelTablesError for one that breaks a rule of check(Provenance).
  KernelTables with_certificate(const Certificate& certificate, bool measured) const;
  KernelTables with_differences(double x, double y) const;
  KernelTables with_text(const KernelText& text) const;

 private:
  KernelTables(std::shared_ptr<const std::byte> owner, std::span<const std::byte> bytes)
      : owner_(std::move(owner)), bytes_(bytes) {}

  std::shared_ptr<const std::byte> owner_;
  std::span<const std::byte> bytes_;
};

struct LoadOptions {
  /// Largest u-error that the certificate may admit.
  double max_u_error = std::numeric_limits<double>::infinity();
};

/// Reads a file of baked tables. Throws KernelTablesError, with the name of the file, if it cannot
/// be read, is no such file or its certificate admits a larger error than `options` allow.
KernelTables load(const std::filesystem::path& path, const LoadOptions& options = {});

/// Writes the bytes of `tables` as a file. Throws KernelTablesError, with the name of the file, on
/// any failure; then nothing is left behind and a file already at `path` is as it was.
void save(const std::filesystem::path& path, const KernelTables& tables);

/// Whether the file begins as one of baked tables.
bool is_kernel_file(const std::filesystem::path& path);

}  // namespace vndf
