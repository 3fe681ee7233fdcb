// Sources of tables and kernel: what they hold, and that nothing of ours is left to include. That
// they compute what the library computes is tested where they are compiled.
#include "vndf/devices/export_source.h"

#include <string>
#include <vector>

#include "support/baked_tables.h"
#include "support/catch.h"
#include "vndf/devices/amalgamate.h"
#include "vndf/devices/table_text.h"

using namespace vndf;
using namespace vndf::devices;

namespace {

constexpr auto kLanguages = {ShadingLanguage::glsl, ShadingLanguage::hlsl, ShadingLanguage::metal};

bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// How often `part` is in `text`.
std::size_t count(const std::string& text, const std::string& part) {
  std::size_t result = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size())
    ++result;
  return result;
}

}  // namespace

TEST_CASE("a header includes the standard library alone, each header of it once") {
  const std::string text = export_header(test::baked_tables("ggx"), "ggx");
  CHECK(count(text, "#include \"") == 0);
  CHECK(count(text, "#include <cmath>") == 1);
  CHECK(holds(text, "inline Kernel ggx_kernel()"));
  CHECK(holds(text, "VNDF_DEVICE inline Kernel ggx_kernel_at(const void* bytes)"));
  CHECK(count(text, "class Kernel {") == 1);
}

TEST_CASE("a header for CUDA keeps the tables on the device") {
  const std::string text = export_cuda(test::baked_tables("ggx"), "ggx");
  CHECK(holds(text, "__device__ alignas(64) const std::uint32_t ggx_words[]"));
  CHECK(holds(text, "__device__ inline Kernel ggx_kernel()"));
}

TEST_CASE("no word of C++ is left in a shading language, and every name has the prefix") {
  for (const ShadingLanguage language : kLanguages) {
    const std::string text = kernel_in(language);
    for (const char* word : {"VNDF_FUNCTION", "VNDF_APART", "VNDF_COLD", "VNDF_IN", "VNDF_RARELY",
                             "VNDF_CONSTANT", "std::", "as_float4", "constexpr", " smaller("})
      CHECK_FALSE(holds(text, word));
    CHECK(holds(text, " vndf_smaller("));
    CHECK(holds(text, "vndf_sample_towards("));
  }
}

TEST_CASE("tables as constants come with the source, and those of a buffer do not") {
  const KernelTables tables = test::baked_tables("ggx");
  for (const ShadingLanguage language : kLanguages) {
    const std::string constants = export_shading(tables, language, {"ggx", TablePlace::constants});
    const std::string buffer = export_shading(tables, language, {"ggx", TablePlace::buffer});
    CHECK(holds(constants, "vndf_ggx_words[" + std::to_string(word_count(tables)) + "]"));
    CHECK(count(buffer, "_words[") == 0);
    CHECK(buffer.size() < 40000);
    CHECK(holds(constants, "VndfTables vndf_ggx()"));
  }
}

TEST_CASE("a source says what it is of and how large its errors are") {
  const KernelTables tables = test::baked_tables("ggx");
  const std::string text = about(tables);
  CHECK(holds(text, "Visible normals of ggx"));
  CHECK(holds(text, "Largest u-error"));
  KernelText hostile;
  hostile.distribution = "a\n#error b\\";
  CHECK(count(about(tables.with_text(hostile)), "\n") == 2);  // all of it stays in the comment
}

TEST_CASE("names must be identifiers in all languages") {
  for (const char* good : {"ggx", "a", "student_t_2_5", "G2"}) CHECK_FALSE(check_name(good));
  for (const char* bad : {"", "2ggx", "_ggx", "ggx_", "a__b", "a-b", "a b", "\xc3\xa4"})
    CHECK(check_name(bad));
  CHECK(check_name(std::string(65, 'a')));
}
