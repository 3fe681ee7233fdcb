// Writes sources into a temporary folder and runs compilers there.
#include "devices/shader_compiler.h"

#include <cstdlib>
#include <cstring>
#include <fstream>
#include <stdexcept>

#include "devices/run_tool.h"
#include "support/temporary_folder.h"

namespace vndf::test {
namespace {

using devices::ShadingLanguage;
using devices::TablePlace;

/// The options of glslangValidator: SPIR-V, and its front end for HLSL.
constexpr const char* kGlsl = "-V";
constexpr const char* kHlsl = "-V -D -e main -S comp";

void write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

/// `program`, compiled, in a folder with the files that it includes.
Spirv compile_in(const TemporaryFolder& folder, const std::string& options,
                 const std::string& program) {
  run_tool(VNDF_GLSLANG " " + options + " -I" VNDF_SHADERS " -I" + folder.path().string() + " -o " +
           (folder / "shader.spv").string() + " " + program);
  const std::string bytes = content(folder / "shader.spv");
  Spirv words(bytes.size() / sizeof(Spirv::value_type));
  std::memcpy(words.data(), bytes.data(), words.size() * sizeof(Spirv::value_type));
  return words;
}

std::string crossed(const Spirv& spirv, const std::string& options) {
  const TemporaryFolder folder;
  write(folder / "shader.spv",
        {reinterpret_cast<const char*>(spirv.data()), spirv.size() * sizeof(Spirv::value_type)});
  run_tool(VNDF_SPIRV_CROSS " " + (folder / "shader.spv").string() + " " + options + " --output " +
           (folder / "out").string());
  return content(folder / "out");
}

}  // namespace

ShaderTables exported_shader(const KernelTables& tables, ShadingLanguage language,
                             TablePlace place) {
  const std::string source = export_shading(tables, language, {"golden", place});
  if (place == TablePlace::constants) return {language, source, "vndf_golden()"};
  return {language, "#define VNDF_WORD(k) words[k]\n" + source, "vndf_golden(0u)"};
}

Spirv compile(const ShaderTables& tables) {
  const TemporaryFolder folder;
  write(folder / "tables.h", tables.source + "\n#define TABLES " + tables.call + "\n");
  const bool hlsl = tables.language == ShadingLanguage::hlsl;
  return compile_in(folder, hlsl ? kHlsl : kGlsl,
                    hlsl ? VNDF_SHADERS "/golden.hlsl" : VNDF_SHADERS "/golden.comp");
}

Spirv compile_hlsl(const std::string& program) {
  const TemporaryFolder folder;
  write(folder / "program.hlsl", program);
  return compile_in(folder, kHlsl, (folder / "program.hlsl").string());
}

std::string crossed_to_hlsl(const Spirv& spirv) {
  return crossed(spirv, "--hlsl --shader-model 50");
}

std::string crossed_to_metal(const Spirv& spirv) {
  return crossed(spirv, "--msl --msl-version 20000");
}

}  // namespace vndf::test
