// The words of the kernel's text in each shading language.
#include "vndf/devices/translate.h"

#include <array>
#include <map>
#include <regex>

#include "vndf/devices/embedded_text.h"

namespace vndf::devices {
namespace {

using Words = std::map<std::string, std::string, std::less<>>;

/// What all of them write otherwise than the kernel's text: they put functions in place
/// themselves, and pass parameters by value.
const Words kCommonWords{
    {"VNDF_FUNCTION ", ""}, {"VNDF_APART_FUNCTION ", ""}, {"VNDF_COLD_FUNCTION ", ""},
    {"VNDF_RARELY ", ""},   {"VNDF_CONSTANT ", "const "},
};

Words words_of(ShadingLanguage language) {
  switch (language) {
    case ShadingLanguage::glsl:
      return {{"float4", "vec4"},
              {"uint4", "uvec4"},
              {"as_uint", "floatBitsToUint"},
              {"as_uint4", "floatBitsToUint"},
              {"as_float", "uintBitsToFloat"},
              {"as_float4", "uintBitsToFloat"}};
    case ShadingLanguage::hlsl:
      return {{"VNDF_CONSTANT ", "static const "},
              {"vec2", "float2"},
              {"vec3", "float3"},
              {"as_uint", "asuint"},
              {"as_uint4", "asuint"},
              {"as_float", "asfloat"},
              {"as_float4", "asfloat"}};
    case ShadingLanguage::metal:
      return {{"VNDF_FUNCTION ", "inline "},
              {"VNDF_APART_FUNCTION ", "inline "},
              {"VNDF_COLD_FUNCTION ", "inline "},
              {"VNDF_CONSTANT ", "constant "},
              {"vec2", "metal::float2"},
              {"vec3", "metal::float3"},
              {"float4", "metal::float4"},
              {"uint4", "metal::uint4"},
              {"as_uint", "as_type<uint>"},
              {"as_uint4", "as_type<metal::uint4>"},
              {"as_float", "as_type<float>"},
              {"as_float4", "as_type<metal::float4>"},
              {"abs", "metal::fabs"},
              {"sqrt", "metal::sqrt"},
              {"exp2", "metal::exp2"}};
  }
  return {};
}

/// Where the tables are, and how a word of 16 bytes of them is read.
std::string_view block_in(ShadingLanguage language) {
  if (language == ShadingLanguage::metal)
    return R"(
/// Where the tables are.
struct Block {
  VNDF_ADDRESS const uint4* words;
};
VNDF_FUNCTION uint4 word_of(Block block, uint k) {
  return block.words[k];
}

)";
  return R"(
/// Where the tables are: which of the words of 16 bytes is their first.
struct Block {
  uint first;
};
VNDF_FUNCTION uint4 word_of(Block block, uint k) {
  return VNDF_WORD(block.first + k);
}

)";
}

/// The functions and structs that `text` defines and that do not begin with vndf already.
Words prefixed_names(std::string_view text) {
  static const std::regex kDefinition(R"((?:VNDF_FUNCTION \w+|struct) (\w+))");
  Words words;
  for (auto at = std::cregex_iterator(text.data(), text.data() + text.size(), kDefinition);
       at != std::cregex_iterator(); ++at)
    words[(*at)[1]] = "vndf_" + (*at)[1].str();
  return words;
}

std::string_view names_of_languages() {
  return embedded_text("vndf/kernel_text/shading_language.h");
}

Words all_words(ShadingLanguage language) {
  Words words = words_of(language);
  words.insert(kCommonWords.begin(), kCommonWords.end());
  words.merge(prefixed_names(names_of_languages()));
  words.merge(prefixed_names(block_in(language)));
  return words;
}

}  // namespace

std::string translate(std::string_view text, ShadingLanguage language) {
  static const std::regex kWord(R"(VNDF_IN\((\w+)\)|VNDF_\w+ |\w+)");
  const Words words = all_words(language);
  std::string result;
  const char* rest = text.data();
  for (auto at = std::cregex_iterator(text.data(), text.data() + text.size(), kWord);
       at != std::cregex_iterator(); ++at) {
    const bool parameter = (*at)[1].matched;
    const std::string word = parameter ? (*at)[1].str() : at->str();
    const auto known = words.find(word);
    result.append(rest, (*at)[0].first).append(known == words.end() ? word : known->second);
    rest = (*at)[0].second;
  }
  return result.append(rest, text.data() + text.size());
}

std::string kernel_in(ShadingLanguage language) {
  std::string text(block_in(language));
  text += names_of_languages();
  for (const char* part : {"tables", "sample", "map", "evaluate"})
    text.append("\n").append(embedded_text("vndf/kernel_text/" + std::string(part) + ".h"));
  return translate(text, language);
}

}  // namespace vndf::devices
