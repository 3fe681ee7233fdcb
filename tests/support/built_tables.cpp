// Tables built once and shared by the tests.
#include "support/built_tables.h"

#include <map>

#include "vndf/distributions/families.h"
#include "vndf/distributions/parse_distribution.h"

namespace vndf::test {
namespace {

using Cache = std::map<std::string, precompute::BuiltTables>;

const precompute::BuiltTables& built(Cache& cache, const std::string& distribution,
                                     const precompute::BuildOptions& options) {
  const auto found = cache.find(distribution);
  if (found != cache.end()) return found->second;
  const auto d = distributions::parse_distribution(distribution);
  return cache.emplace(distribution, precompute::build_tables(*d, options)).first->second;
}

}  // namespace

const precompute::BuiltTables& large_tables(const std::string& distribution) {
  static Cache cache;
  return built(cache, distribution, {});
}

const precompute::BuiltTables& small_tables(const std::string& distribution) {
  static Cache cache;
  return built(cache, distribution, {.layout = {.rows = 64, .columns = 96}});
}

}  // namespace vndf::test
