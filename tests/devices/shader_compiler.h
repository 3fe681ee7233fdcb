// Compiles exported sources with the main programs of this folder, by the command lines that people
// use: glslangValidator, and spirv-cross.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "vndf/devices/export_source.h"

namespace vndf::test {

using Spirv = std::vector<std::uint32_t>;

/// Exported sources, and the call that gives the tables to test.
struct ShaderTables {
  devices::ShadingLanguage language;
  std::string source, call;
};

/// The source of `tables`, with the words that read a buffer of the test's shaders before it.
ShaderTables exported_shader(const KernelTables& tables, devices::ShadingLanguage language,
                             devices::TablePlace place = devices::TablePlace::buffer);

/// Compiles golden.comp or golden.hlsl with `tables`. Throws std::runtime_error with what the
/// compiler says if it fails.
Spirv compile(const ShaderTables& tables);

/// The HLSL and the Metal that spirv-cross makes of a compiled shader; throw like compile().
std::string crossed_to_hlsl(const Spirv& spirv);
std::string crossed_to_metal(const Spirv& spirv);

/// A whole program in HLSL, compiled; throws like compile().
Spirv compile_hlsl(const std::string& program);

}  // namespace vndf::test
