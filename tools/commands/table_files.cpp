// Files of tables of either kind.
#include "commands/table_files.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <stdexcept>

#include "vndf/distributions/specification.h"

namespace vndf::tools {
namespace {

bool holds_baked_tables(const std::string& path) {
  return names_baked_tables(path) || is_kernel_file(path);
}

}  // namespace

std::string extension_of(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

bool names_baked_tables(const std::string& path) {
  return extension_of(path) == ".vndf";
}

bool names_a_file(const std::string& argument) {
  const auto extension = std::filesystem::path(argument).extension();
  return extension == ".h5" || extension == ".hdf5" || extension == ".exr" ||
         names_baked_tables(argument) || std::filesystem::is_regular_file(argument);
}

AnyTables load_tables(const std::string& path) {
  if (holds_baked_tables(path)) return load(path);
  return io::load(path);
}

io::TableFile load_pair(const std::string& path) {
  if (!holds_baked_tables(path)) return io::load(path);
  throw std::runtime_error(path +
                           ": it holds baked tables and not the pair that they are baked from; "
                           "give the pair, a .h5 or .exr file");
}

Provenance provenance_of(const AnyTables& tables) {
  if (const auto* pair = std::get_if<io::TableFile>(&tables)) return pair->provenance;
  return std::get<KernelTables>(tables).text().provenance;
}

std::unique_ptr<distributions::SlopeDistribution> distribution_of(const std::string& path,
                                                                  const AnyTables& tables) {
  try {
    return distributions::make_distribution(provenance_of(tables).specification);
  } catch (const std::exception& e) {
    throw std::runtime_error(path + ": its distribution cannot be made again: " + e.what());
  }
}

}  // namespace vndf::tools
