// Baked tables and the kernel as one source file of a language, which a renderer compiles without
// vndf. All languages share the text of the kernel (vndf/kernel_text.h).
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "vndf/devices/translate.h"
#include "vndf/kernel_tables.h"

namespace vndf::devices {

/// Where the source finds the tables.
enum class TablePlace {
  buffer,     ///< in memory that the renderer fills with the bytes of the block
  constants,  ///< in the source, for the smallest tables: many compilers copy them for each thread
};

struct ShadingOptions {
  std::string name;  ///< of the tables, an identifier; see check_name()
  TablePlace place = TablePlace::buffer;
};

/// Returns the rule that `name` breaks, or nothing: it must be an identifier in all languages, of
/// letters, digits and single underscores, with a letter first.
std::optional<std::string> check_name(std::string_view name);

/// A C++17 header: class vndf::Kernel (vndf/kernel.h) and the function vndf::NAME_kernel() that
/// returns one. It gives the same normals as the library, bit for bit. Several such headers go
/// together in one source file; the library's own headers do not go beside them. `name` must be
/// one (check_name()).
std::string export_header(const KernelTables& tables, const std::string& name);

/// The same header for CUDA device code. vndf::NAME_kernel() is a device function and reads the
/// tables in global memory; vndf::NAME_kernel_at(bytes) reads a copy of them, in shared memory for
/// example.
std::string export_cuda(const KernelTables& tables, const std::string& name);

/// A source with the kernel's functions, and vndf_NAME() that returns their first argument,
/// VndfTables. From a buffer, GLSL and HLSL read the tables by VNDF_WORD(k), a macro that gives the
/// k-th word of 16 bytes and must be defined before; vndf_NAME(first) says which word is the first
/// of the tables. In Metal the argument is the pointer to that word.
std::string export_shading(const KernelTables& tables, ShadingLanguage language,
                           const ShadingOptions& options);

}  // namespace vndf::devices
