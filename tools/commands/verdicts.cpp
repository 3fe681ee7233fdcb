// The slope distribution of the tables in a file, for the commands that validate against it.
#include "commands/verdicts.h"

#include <filesystem>
#include <random>
#include <stdexcept>

#include "commands/distribution_source.h"

namespace vndf::tools {

std::unique_ptr<distributions::SlopeDistribution> distribution_of(
    const std::string& recipe, const std::string& input_checksum) {
  const auto source = [&] {
    try {
      return distribution_of_recipe(recipe);
    } catch (const std::exception& e) {
      throw std::runtime_error("the distribution of the tables, made by '" + recipe +
                               "', cannot be had again: " + e.what());
    }
  };
  auto again = source();
  if (again.input_checksum != input_checksum)
    throw std::runtime_error("the file that '" + recipe +
                             "' reads has changed since the tables were made from it");
  return std::move(again.distribution);
}

std::unique_ptr<distributions::SlopeDistribution> distribution_of(const AnyTables& tables) {
  if (const auto* pair = std::get_if<io::TableFile>(&tables))
    return distribution_of(pair->provenance.recipe, pair->provenance.input_checksum);
  const KernelText text = std::get<KernelTables>(tables).text();
  return distribution_of(text.recipe, text.input_checksum);
}

bool names_a_file(const std::string& argument) {
  const auto extension = std::filesystem::path(argument).extension();
  return extension == ".h5" || extension == ".hdf5" || extension == ".exr" ||
         names_baked_tables(argument) || std::filesystem::is_regular_file(argument);
}

std::uint64_t fresh_seed() {
  std::random_device random;
  return (std::uint64_t{random()} << 32) | random();
}

}  // namespace vndf::tools
