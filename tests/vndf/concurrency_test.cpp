// What several threads do at once: sample one table, build tables, read files, evaluate formulas.
// Tables are immutable and nothing is global, so each thread must get what it gets alone. The
// sanitizer of data races runs these tests (preset `threads`).
#include <filesystem>
#include <functional>
#include <memory>
#include <thread>
#include <vector>

#include "support/catch.h"
#include "vndf/baking/bake.h"
#include "vndf/batch/sample_batch.h"
#include "vndf/distributions/parse_distribution.h"
#include "vndf/distributions/specification.h"
#include "vndf/io/table_file.h"
#include "vndf/kernel_tables.h"
#include "vndf/precompute/build_tables.h"
#include "vndf/tabulated_sampler.h"

namespace {

using namespace vndf;

constexpr int kThreads = 4;

/// Calls `work` in several threads at once and returns what each made.
template <class Work>
auto at_once(const Work& work) {
  std::vector<decltype(work())> results(kThreads);
  {
    std::vector<std::jthread> threads;
    for (auto& result : results) threads.emplace_back([&] { result = work(); });
  }
  return results;
}

/// Checks that threads make what one thread makes alone.
template <class Work>
void check_same_at_once(const Work& work) {
  const auto alone = work();
  for (const auto& result : at_once(work)) CHECK(result == alone);
}

precompute::BuiltTables built(const std::string& distribution) {
  return precompute::build_tables(*distributions::parse_distribution(distribution),
                                  {.layout = {.rows = 24, .columns = 32}, .threads = 2});
}

/// Normals of a grid of random numbers, seen from one direction.
template <class Sampler>
std::vector<float> normals(const Sampler& sampler) {
  std::vector<float> result;
  for (int i = 0; i <= 40; ++i)
    for (int j = 0; j <= 40; ++j) {
      const auto u1 = static_cast<float>(i) / 40, u2 = static_cast<float>(j) / 40;
      const Vec3<float> wm = sampler.sample({0.6f, 0, 0.8f}, {0.5f, 0.2f}, u1, u2);
      result.insert(result.end(), {wm.x, wm.y, wm.z});
    }
  return result;
}

}  // namespace

TEST_CASE("threads that share a pair of tables draw what one thread draws") {
  const TabulatedSampler<float> sampler(built("ggx").tables);
  check_same_at_once([&] { return normals(sampler); });
}

TEST_CASE("threads that share baked tables draw what one thread draws, one by one and in batches") {
  const KernelTables tables = bake(*built("student-t:gamma=3").tables, {.tolerance = 1e-3});
  check_same_at_once([&] { return normals(tables.kernel()); });
  const std::vector<float> u1{0, 0.25f, 0.5f, 0.75f, 1}, u2{1, 0.1f, 0.5f, 0.9f, 0};
  check_same_at_once([&] {
    std::vector<float> x(u1.size()), y(u1.size()), z(u1.size());
    sample_batch(tables.kernel().at({0.6f, 0, 0.8f}, {0.5f, 0.2f}), u1, u2, {x, y, z});
    x.insert(x.end(), y.begin(), y.end());
    x.insert(x.end(), z.begin(), z.end());
    return x;
  });
}

TEST_CASE("tables that are built at once are those that are built alone") {
  for (const char* distribution : {"beckmann", "exponential-power:p=8"})
    check_same_at_once([&] {
      const auto tables = built(distribution).tables;
      return normals(TabulatedSampler<float>(tables));
    });
}

TEST_CASE("threads write and read files at once") {
  const auto tables = built("ggx");
  const io::TableFile file{tables.tables, {{"ggx"}, "command", "program"}, tables.certificate};
  for (const char* extension : {".h5", ".exr"}) {
    const auto path =
        std::filesystem::temp_directory_path() / (std::string("vndf-concurrency-test") + extension);
    io::save(path, file);
    check_same_at_once([&] {
      io::save(path, file);
      return normals(TabulatedSampler<float>(io::load(path).tables));
    });
    std::filesystem::remove(path);
  }
}

TEST_CASE("threads evaluate one formula at once, and make others") {
  const auto shared =
      distributions::make_distribution(distributions::specify_p22({"exp(-k*r^2)", {{"k", 2}}}));
  check_same_at_once([&] {
    const auto own =
        distributions::make_distribution(distributions::specify_p22({"(1+r^2/2)^-3", {}}));
    std::vector<double> densities;
    for (int i = 0; i < 1000; ++i) {
      densities.push_back(shared->p22(i * 1e-3));
      densities.push_back(own->p22(i * 1e-3));
    }
    return densities;
  });
}
