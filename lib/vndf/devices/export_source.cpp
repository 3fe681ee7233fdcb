// Composes source files of the kernel's text and the tables' numbers.
#include "vndf/devices/export_source.h"

#include <algorithm>

#include "vndf/devices/amalgamate.h"
#include "vndf/devices/table_text.h"
#include "vndf/version.h"

namespace vndf::devices {
namespace {

/// Files that were exported by different versions have different kernels under the same names.
constexpr std::string_view kVersionGuard = R"(
#if defined(VNDF_EXPORTED_BY) && VNDF_EXPORTED_BY != @VERSION@
#error "exported by different versions of vndf: export all tables again with one of them"
#endif
#ifndef VNDF_EXPORTED_BY
#define VNDF_EXPORTED_BY @VERSION@
@KERNEL@
#endif  // VNDF_EXPORTED_BY

)";

std::string replaced(std::string text, std::string_view what, std::string_view by) {
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size())
    text.replace(at, what.size(), by);
  return text;
}

/// The kernel, once for all files that are exported.
std::string guarded(const std::string& kernel) {
  constexpr int kVersion =
      VNDF_VERSION_MAJOR * 10000 + VNDF_VERSION_MINOR * 100 + VNDF_VERSION_PATCH;
  const std::string text =
      replaced(std::string(kVersionGuard), "@VERSION@", std::to_string(kVersion));
  return replaced(text, "@KERNEL@", kernel);
}

/// Sampling and the functions need neither the texts nor the samples of the specification.
KernelTables without_text(const KernelTables& tables) {
  return tables.with_text({});
}

constexpr std::string_view kHeaderTables = R"(namespace vndf {

/// The bytes of a block, which tables/FORMAT.md of vndf describes.
@PLACE@ alignas(64) @CONSTANT@ std::uint32_t @NAME@_words[] = {
@NUMBERS@};

/// The sampler of a copy of the same bytes, which must begin at a multiple of 16 and outlive it.
VNDF_DEVICE inline Kernel @NAME@_kernel_at(const void* bytes) {
  using kernel::float_of;
  kernel::VndfTables t{};
@STATEMENTS@  t.block.bytes = static_cast<const unsigned char*>(bytes);
  return Kernel(t);
}

/// The sampler.
@PLACE@ inline Kernel @NAME@_kernel() {
  return @NAME@_kernel_at(@NAME@_words);
}

}  // namespace vndf
)";

/// `place` is where CUDA keeps the words, and what may call the function that reads them.
std::string cpp_header(const KernelTables& tables, const std::string& name,
                       const std::string& place, std::string_view constant) {
  const KernelTables bare = without_text(tables);
  std::string text = replaced(std::string(kHeaderTables), "@PLACE@ ", place);
  text = replaced(text, "@CONSTANT@", constant);
  text = replaced(text, "@NAME@", name);
  text = replaced(text, "@STATEMENTS@", number_statements(bare.kernel().tables()));
  text = replaced(text, "@NUMBERS@", word_list(bare, "", ""));
  return about(tables) + "#pragma once\n\n" + guarded(amalgamate("vndf/kernel.h")) + text;
}

/// What differs between languages and places of the tables: the declaration of the words, how a
/// function is told where they are, and what it says of them.
struct ShadingParts {
  std::string words, parameter, where;
};

constexpr std::string_view kGlslConstants = R"(#ifdef VNDF_WORD
#error "only one source can have its tables as constants: export them for a buffer"
#endif
uvec4 vndf_@NAME@_words[@COUNT@] = uvec4[@COUNT@](
@NUMBERS@);
#define VNDF_WORD(k) vndf_@NAME@_words[k]
)";
constexpr std::string_view kHlslConstants = R"(#ifdef VNDF_WORD
#error "only one source can have its tables as constants: export them for a buffer"
#endif
static uint4 vndf_@NAME@_words[@COUNT@] = {
@NUMBERS@};
#define VNDF_WORD(k) vndf_@NAME@_words[k]
)";
constexpr std::string_view kMetalConstants = R"(#include <metal_stdlib>

#define VNDF_ADDRESS constant
constant metal::uint4 vndf_@NAME@_words[@COUNT@] = {
@NUMBERS@};
)";

ShadingParts constants_of(const KernelTables& tables, ShadingLanguage language) {
  const std::string count = std::to_string(word_count(tables));
  const auto with_numbers = [&](std::string_view words, std::string_view open,
                                std::string_view close) {
    const std::string counted = replaced(std::string(words), "@COUNT@", count);
    return replaced(counted, "@NUMBERS@", word_list(tables, open, close));
  };
  switch (language) {
    case ShadingLanguage::glsl:
      return {with_numbers(kGlslConstants, "uvec4(", ")"), "", "first = 0u"};
    case ShadingLanguage::hlsl:
      return {with_numbers(kHlslConstants, "{", "}"), "", "first = 0u"};
    case ShadingLanguage::metal:
      return {with_numbers(kMetalConstants, "{", "}"), "", "words = vndf_@NAME@_words"};
  }
  return {};
}

ShadingParts buffer_for(ShadingLanguage language) {
  if (language == ShadingLanguage::metal)
    return {
        "#include <metal_stdlib>\n\n"
        "/// The address space of the tables.\n"
        "#ifndef VNDF_ADDRESS\n#define VNDF_ADDRESS device\n#endif\n",
        "VNDF_ADDRESS const uint4* words", "words = words"};
  return {
      "#ifndef VNDF_WORD\n"
      "#error \"define VNDF_WORD(k) first: the k-th word of 16 bytes of the tables' buffer\"\n"
      "#endif\n",
      "uint first", "first = first"};
}

/// Returns the tables, in the words of the kernel.
constexpr std::string_view kTablesFunction = R"(
/// The tables, which are the first argument of all functions.
VNDF_FUNCTION VndfTables vndf_@NAME@(@PARAMETER@) {
  VndfTables t;
@STATEMENTS@  t.block.@WHERE@;
  return t;
}
)";

}  // namespace

std::optional<std::string> check_name(std::string_view name) {
  const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  const auto fits = [&](char c) { return letter(c) || (c >= '0' && c <= '9') || c == '_'; };
  const bool valid = !name.empty() && name.size() <= 64 && letter(name.front()) &&
                     name.back() != '_' && std::ranges::all_of(name, fits) &&
                     name.find("__") == std::string_view::npos;
  if (valid) return {};
  return replaced(
      "'@NAME@' is no name in all languages: take at most 64 letters, digits and single "
      "underscores, with a letter first",
      "@NAME@", name);
}

std::string export_header(const KernelTables& tables, const std::string& name) {
  return cpp_header(tables, name, "", "inline constexpr");
}

std::string export_cuda(const KernelTables& tables, const std::string& name) {
  return cpp_header(tables, name, "__device__ ", "const");
}

std::string export_shading(const KernelTables& tables, ShadingLanguage language,
                           const ShadingOptions& options) {
  const KernelTables bare = without_text(tables);
  const ShadingParts parts =
      options.place == TablePlace::constants ? constants_of(bare, language) : buffer_for(language);
  std::string function = replaced(std::string(kTablesFunction), "@PARAMETER@", parts.parameter);
  function = replaced(function, "@WHERE@", parts.where);
  function = replaced(function, "@STATEMENTS@", number_statements(bare.kernel().tables()));
  const std::string text =
      parts.words + guarded(kernel_in(language)) + translate(function, language);
  return about(tables) + "\n" + replaced(text, "@NAME@", options.name);
}

}  // namespace vndf::devices
