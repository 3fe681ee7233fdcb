// Writes the numbers of tables so that every bit of them arrives.
#include "vndf/devices/table_text.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

#include "vndf/devices/printed.h"
#include "vndf/version.h"

namespace vndf::devices {
namespace {

std::string statement(const char* name, float value) {
  return printed("  t.%s = float_of(0x%08xu);  // %.9g\n", name, kernel::bits_of(value),
                 static_cast<double>(value));
}

std::string statement(const char* name, std::uint32_t value) {
  return printed("  t.%s = 0x%xu;\n", name, value);
}

constexpr std::size_t kWordBytes = 16, kWordNumbers = 4;

}  // namespace

std::string number_statements(const kernel::VndfTables& t) {
  std::string text;
  const auto add = [&](const char* name, auto value) { text += statement(name, value); };
  add("unit", t.unit);
  add("scale_root", t.scale_root);
  add("scale_constant", t.scale_constant);
  add("rim", t.rim);
  add("least_root", t.least_root);
  add("most_root", t.most_root);
  add("direction_offset", t.direction_offset);
  add("slope_middle", t.slope_middle);
  add("slope_offset", t.slope_offset);
  add("slope_most", t.slope_most);
  add("direction_guide", t.direction_guide);
  add("direction_shift", t.direction_shift);
  add("column_shift", t.column_shift);
  add("column_upper", t.column_upper);
  add("column_roots", t.column_roots);
  add("column_offset", t.column_offset);
  add("column_span", t.column_span);
  add("column_mirror", t.column_mirror);
  add("marginal_guide", t.marginal_guide);
  add("conditional_guide", t.conditional_guide);
  add("slope_guide", t.slope_guide);
  add("slope_shift", t.slope_shift);
  add("slope_upper", t.slope_upper);
  add("kind", t.kind);
  add("separable", t.separable);
  add("ndf.segments", t.ndf.segments);
  add("ndf.count", t.ndf.count);
  add("backfacing.segments", t.backfacing.segments);
  add("backfacing.count", t.backfacing.count);
  add("below.most_cotangent", t.below.most_cotangent);
  add("below.least_place", t.below.least_place);
  add("below.direction_guide", t.below.direction_guide);
  add("below.direction_shift", t.below.direction_shift);
  add("below.marginal_guide", t.below.marginal_guide);
  add("below.conditional_guide", t.below.conditional_guide);
  add("below.slope_guide", t.below.slope_guide);
  add("below.slope_shift", t.below.slope_shift);
  add("below.slope_most", t.below.slope_most);
  // A number that is added to the struct must be added here.
  static_assert(sizeof t == 38 * sizeof(float) + sizeof t.block);
  return text;
}

std::string on_one_line(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < ' ') c = ' ';
  while (!text.empty() && (text.back() == ' ' || text.back() == '\\')) text.pop_back();
  return text;
}

std::size_t word_count(const KernelTables& tables) {
  return (tables.bytes().size() + kWordBytes - 1) / kWordBytes;
}

std::string word_list(const KernelTables& tables, std::string_view open, std::string_view close) {
  std::string text;
  for (std::size_t word = 0; word < word_count(tables); ++word) {
    std::array<std::uint32_t, kWordNumbers> numbers{};
    const auto rest = tables.bytes().subspan(word * kWordBytes);
    std::memcpy(numbers.data(), rest.data(), std::min(rest.size(), kWordBytes));
    text.append("  ").append(open);
    for (std::size_t k = 0; k < kWordNumbers; ++k)
      text += printed(k + 1 < kWordNumbers ? "0x%08xu, " : "0x%08xu", numbers[k]);
    text.append(close).append(word + 1 < word_count(tables) ? ",\n" : "\n");
  }
  return text;
}

std::string about(const KernelTables& tables) {
  const KernelText text = tables.text();
  const Certificate certificate = tables.certificate();
  std::string lines = "// Visible normals of " + on_one_line(text.distribution) +
                      ", exported by vndf " VNDF_VERSION ".\n";
  if (!text.provenance.specification.text.empty())
    lines += "// Distribution: " + on_one_line(text.provenance.specification.text) + "\n";
  lines += printed("// Largest u-error: %.3g of slope x, %.3g of slope y given x%s.\n",
                   certificate.marginal.max_u_error, certificate.conditional.max_u_error,
                   tables.header().certified != 0 ? "" : " (estimated)");
  return lines;
}

}  // namespace vndf::devices
