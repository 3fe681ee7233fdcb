// Files of tables of either kind.
#include "commands/table_files.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <stdexcept>
#include <string_view>

namespace vndf::tools {
namespace {

/// How recipes begin and end; what is baked comes before the name of the output.
constexpr std::string_view kBuild = "vndf build ", kOutput = " -o ", kBaking = " --tolerance ";

bool holds_baked_tables(const std::string& path) {
  return names_baked_tables(path) || is_kernel_file(path);
}

}  // namespace

bool names_baked_tables(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension == ".vndf";
}

AnyTables load_tables(const std::string& path) {
  if (holds_baked_tables(path)) return load(path);
  return io::load(path);
}

io::TableFile load_pair(const std::string& path) {
  if (!holds_baked_tables(path)) return io::load(path);
  const std::string recipe = load(path).text().recipe;
  throw std::runtime_error(path +
                           ": it holds baked tables and not the pair that they are baked from; "
                           "give the pair, a .h5 or .exr file" +
                           made_by(recipe, "pair.h5"));
}

std::optional<std::string> build_recipe(const std::string& recipe, const std::string& output,
                                        const std::string& bake_options) {
  if (!recipe.starts_with(kBuild)) return {};
  const auto end = std::min(recipe.rfind(kOutput), recipe.rfind(kBaking));
  return recipe.substr(0, end) + bake_options + std::string(kOutput) +
         std::filesystem::path(output).filename().string();
}

std::string made_by(const std::string& recipe, const std::string& output) {
  const auto build = build_recipe(recipe, output);
  return build ? ", made by '" + *build + "'" : "";
}

}  // namespace vndf::tools
