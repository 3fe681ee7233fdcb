// Baked tables: load a file of them, or view one in memory, and sample from their kernel().
//
//   const vndf::KernelTables tables = vndf::load("ggx.vndf");
//   const vndf::Kernel ggx = tables.kernel();
#pragma once

#include <cstddef>
#include <filesystem>
#include <limits>
#include <memory>
#include <span>
#include <string>

#include "vndf/certificate.h"
#include "vndf/kernel.h"
#include "vndf/kernel_block.h"
#include "vndf/provenance.h"

namespace vndf {

/// What a block says of itself beside the numbers. Sampling does not read it.
struct KernelText {
  std::string distribution = {};  ///< name, for people
  Provenance provenance = {};
};

/// Immutable tables. Copies share them, also among threads.
class KernelTables {
 public:
  /// The tables in `bytes`, which are not copied: they must begin at a multiple of kKernelAlignment
  /// and outlive all kernels. Allocates nothing. Throws KernelTablesError unless everything that
  /// sampling will read is inside them and the checksum is right (check_block()).
  static KernelTables view(std::span<const std::byte> bytes);

  /// As view(), for a copy of `bytes` that the tables own; `bytes` may begin anywhere.
  static KernelTables copy(std::span<const std::byte> bytes);

  /// The block, which is also what save() writes.
  std::span<const std::byte> bytes() const { return bytes_; }
  /// Its header, for reports and exports.
  const KernelHeader& header() const;
  /// Bytes of guides and patches, which are what sampling reads.
  std::size_t sampling_bytes() const { return header().sampling_bytes; }
  /// The errors of the kernel. header().certified says whether they were measured against the exact
  /// distribution; else they are those of the pair with the differences from it.
  Certificate certificate() const;
  KernelText text() const;

  /// The sampler, which refers to the bytes and does not own them.
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
  /// Largest u-error that the certificate may admit for directions above the horizon;
  /// Certificate::below has that for those below it.
  double max_u_error = std::numeric_limits<double>::infinity();
};

/// Reads a file of baked tables. Throws KernelTablesError, which names the file, if it cannot be
/// read, is not such a file or has a certificate that admits a larger error than `options` allow.
KernelTables load(const std::filesystem::path& path, const LoadOptions& options = {});

/// Writes the bytes of `tables` as a file. Throws KernelTablesError, which names the file, on any
/// failure; then nothing is left behind and a file that was at `path` is as it was.
void save(const std::filesystem::path& path, const KernelTables& tables);

/// Whether the file at `path` begins like one of baked tables; false if it is no regular file or
/// cannot be read.
bool is_kernel_file(const std::filesystem::path& path);

}  // namespace vndf
