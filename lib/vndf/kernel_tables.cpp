// Baked tables in memory and in files.
#include "vndf/kernel_tables.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <new>
#include <string_view>
#include <utility>
#include <vector>

#include "vndf/replace_file.h"
#include "vndf/surface_slopes.h"

namespace vndf {
namespace {

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
  if (size > kKernelMostBytes)
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
  if (const auto& surface = text.provenance.surface)
    bytes.append(text_of(*surface)).push_back('\0');
  return bytes;
}

}  // namespace

KernelTables KernelTables::view(std::span<const std::byte> bytes) {
  check_block(bytes);
  return {nullptr, bytes};
}

KernelTables KernelTables::copy(std::span<const std::byte> bytes) {
  const auto owner = aligned_bytes(std::max<std::size_t>(bytes.size(), 1));
  std::copy(bytes.begin(), bytes.end(), owner.get());
  const std::span<const std::byte> own(owner.get(), bytes.size());
  check_block(own);
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
  KernelText text;
  std::size_t k = 0;
  for (std::string* part : parts_of(text)) *part = text_at(bytes_, k++).value_or("");
  if (const auto surface = text_at(bytes_, kKernelSurfaceText))
    text.provenance.surface = surface_slopes_of(*surface);
  Specification& specification = text.provenance.specification;
  for (std::size_t i = 0; i < header().sample_count; ++i) {
    const std::size_t place = header().samples + i * kKernelSampleBytes;
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
  t.below.most_cotangent = h.below_most_cotangent;
  t.below.least_place = h.below_least_place;
  t.below.direction_guide = guide(h.below_direction);
  t.below.direction_shift = h.below_direction.shift;
  t.below.marginal_guide = guide(h.below_marginal);
  t.below.conditional_guide = guide(h.separable != 0 ? h.conditional : h.below_conditional);
  t.below.slope_guide = guide(h.below_slope);
  t.below.slope_shift = h.below_slope.shift;
  t.below.slope_most = h.below_slope_most;
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
    h.sample_count = static_cast<std::uint32_t>(samples.size() / kKernelSampleBytes);
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
  const auto bytes = tables.bytes();
  try {
    replace_file(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  } catch (const ReplaceError& error) {
    throw error_in(path, std::string(error.what()) + "; " + error.remedy);
  }
}

bool is_kernel_file(const std::filesystem::path& path) {
  std::error_code none;
  if (!std::filesystem::is_regular_file(path, none)) return false;  // a pipe would be waited for
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
  for (const double u_error : {c.marginal.max_u_error, c.conditional.max_u_error})
    if (!(u_error <= options.max_u_error))  // one that is no number is above everything
      throw error_in(path, "its certificate admits a u-error of " + digits_of(u_error) +
                               ", above " + digits_of(options.max_u_error) +
                               "; bake it with a smaller --tolerance");
  return tables;
}

}  // namespace vndf
