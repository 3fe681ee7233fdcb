// The exported GLSL and HLSL on a device of Vulkan, which the environment chooses
// (vulkan_device.h), against golden vectors.
#include <algorithm>
#include <string>
#include <vector>

#include "devices/exported_cases.h"
#include "devices/shader_compiler.h"
#include "devices/vulkan_device.h"
#include "support/catch.h"

using namespace vndf;
using namespace vndf::test;
using devices::ShadingLanguage;
using devices::TablePlace;

namespace {

constexpr auto kLanguages = {ShadingLanguage::glsl, ShadingLanguage::hlsl};

const VulkanDevice& device() {
  static const VulkanDevice one;
  return one;
}

/// What differs where the device runs a shader on the golden vectors of a case.
std::string differences_of(const Spirv& shader, const ExportedCase& exported,
                           std::span<const std::byte> buffer) {
  const auto& vectors = vectors_of(exported);
  const std::vector<float> inputs = device_inputs(vectors);
  const ShaderBuffers buffers{buffer, inputs, vectors.size() * kDeviceOutputs};
  return differences(vectors, device().run(shader, buffers, vectors.size() / kGroupSize));
}

std::string differences_of(const Spirv& shader, const ExportedCase& exported) {
  return differences_of(shader, exported, tables_of(exported).bytes());
}

}  // namespace

TEST_CASE("the exported tables are of every kind that the kernel tells apart") {
  for (const ExportedCase& exported : kExportedCases) {
    CAPTURE(exported.distribution);
    const kernel::VndfTables tables = tables_of(exported).kernel().tables();
    CHECK((tables.separable == 0) == exported.rows);
    CHECK((tables.column_roots != 0) == exported.roots);
    CHECK((tables.rim > 0) == exported.rim);
  }
}

TEST_CASE("sources that read their tables from a buffer keep the golden vectors") {
  for (const ShadingLanguage language : kLanguages)
    for (const ExportedCase& exported : kExportedCases) {
      CAPTURE(device().name(), language == ShadingLanguage::hlsl, exported.distribution);
      CHECK(differences_of(compile(exported_shader(tables_of(exported), language)), exported) ==
            "");
    }
}

// They do not run here: lavapipe and SwiftShader copy the constants wherever they are read, and
// need minutes or more stack than they have.
TEST_CASE("sources whose tables are constants compile") {
  for (const ShadingLanguage language : kLanguages)
    CHECK(compile(exported_shader(tables_of(kPlainCase), language, TablePlace::constants)).size() >
          tables_of(kPlainCase).bytes().size() / sizeof(Spirv::value_type));
}

TEST_CASE("two tables share a shader and a buffer") {
  const KernelTables &first = tables_of(kPlainCase), &second = tables_of(kRowsCase);
  const std::size_t words = (first.bytes().size() + 15) / 16;
  std::vector<std::byte> buffer(words * 16 + second.bytes().size());
  std::ranges::copy(first.bytes(), buffer.begin());
  std::ranges::copy(second.bytes(), buffer.end() - second.bytes().size());
  const auto source = [](const KernelTables& tables, const char* name) {
    return export_shading(tables, ShadingLanguage::glsl, {name, TablePlace::buffer});
  };
  const std::string sources =
      "#define VNDF_WORD(k) words[k]\n" + source(first, "first") + source(second, "second");
  const auto differ = [&](const std::string& call, const ExportedCase& exported) {
    return differences_of(compile({ShadingLanguage::glsl, sources, call}), exported, buffer);
  };
  CHECK(differ("vndf_first(0u)", kPlainCase) == "");
  CHECK(differ("vndf_second(" + std::to_string(words) + "u)", kRowsCase) == "");
}

TEST_CASE("spirv-cross makes HLSL of the GLSL that keeps the golden vectors, and Metal") {
  const Spirv glsl = compile(exported_shader(tables_of(kRowsCase), ShadingLanguage::glsl));
  CHECK(differences_of(compile_hlsl(crossed_to_hlsl(glsl)), kRowsCase) == "");
  CHECK_THAT(crossed_to_metal(glsl), contains("kernel void"));
}

namespace {

/// A slip that a port could have: what stands in the exported text, and what instead.
struct Slip {
  const char* right;
  const char* wrong;
};

std::string with_slip(std::string text, const Slip& slip) {
  const std::size_t at = text.find(slip.right);
  REQUIRE(at != std::string::npos);
  return text.replace(at, std::string(slip.right).size(), slip.wrong);
}

constexpr Slip kSlips[] = {
    {"kVndfMostU = 0.999999940395f", "kVndfMostU = 0.99999f"},
    {"a > 0.5f ? 1.0f : 0.0f", "a > 0.25f ? 1.0f : 0.0f"},
    {"? word.x : word.z", "? word.z : word.x"},
    {"w.alpha_x * (w.x * x + w.y * y)", "w.alpha_x * (w.x * x - w.y * y)"},
    {"2.0f * a[1] + f", "a[1] + f"},
    {"(ax * ay * square * square)", "(ax * ay * square)"},
    {"step < 31u", "step < 24u"},
};

}  // namespace

TEST_CASE("a slip in the text of the kernel breaks golden vectors") {
  const ShaderTables right = exported_shader(tables_of(kPlainCase), ShadingLanguage::glsl);
  for (const Slip& slip : kSlips) {
    CAPTURE(slip.right, slip.wrong);
    const Spirv shader = compile({right.language, with_slip(right.source, slip), right.call});
    CHECK(differences_of(shader, kPlainCase) != "");
  }
}
