// The exported GLSL and HLSL on a device of Vulkan, which the environment chooses
// (vulkan_device.h), against golden vectors.
#include <algorithm>
#include <cmath>
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

namespace {

/// What the page says of surfaces, in place of the sampler that the shader calls.
constexpr const char* kOnSurface = R"(
vec3 sampled_on_surface(VndfTables t, vec3 wi, vec2 alpha, float shear, vec2 mean, vec2 u) {
  vec3 w = vec3(wi.x + shear * wi.y, wi.y, wi.z - dot(mean, wi.xy));
  vec3 m = vndf_drawn_towards(t, w, alpha.x, alpha.y, u.x, u.y);
  return vndf_unit_or_up(vec3(m.x - mean.x * m.z, m.y + shear * m.x - mean.y * m.z, m.z));
}
#define vndf_sample_towards(t, wi, x, y, u1, u2) \
  sampled_on_surface(t, wi, vec2(x, y), 0.5f, vec2(0.1f, -0.05f), vec2(u1, u2))
)";

}  // namespace

TEST_CASE("a shader shears directions and normals to draw on a surface") {
  ShaderTables shader = exported_shader(tables_of(kRowsCase), ShadingLanguage::glsl);
  shader.source += kOnSurface;
  const auto& vectors = vectors_of(kRowsCase);
  const std::vector<float> inputs = device_inputs(vectors);
  const auto outputs = device().run(
      compile(shader), {tables_of(kRowsCase).bytes(), inputs, vectors.size() * kDeviceOutputs},
      vectors.size() / kGroupSize);
  const Kernel kernel = tables_of(kRowsCase).kernel();
  int compared = 0;
  for (std::size_t i = 0; i < vectors.size(); ++i) {
    const auto& [wi, alpha, u1, u2] = vectors[i].input;
    // Elsewhere rounding may be multiplied: at grazing incidence, and where a roughness is small.
    if (!(wi.z > 0.3f && alpha.x > 0.05f && alpha.y > 0.05f && alpha.x < 1 && alpha.y < 1))
      continue;
    ++compared;
    const RoughSurface<float> surface(alpha, 0.5f, {0.1f, -0.05f});
    const Vec3<float> here = kernel.sample(wi, surface, u1, u2);
    const Vec3<float> there = device_output(outputs, i).wm;
    CAPTURE(i, wi.x, wi.y, wi.z, alpha.x, alpha.y, u1, u2);
    CHECK(std::hypot(here.x - there.x, here.y - there.y, here.z - there.z) < 1e-5f);
  }
  CHECK(compared > 100);
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
