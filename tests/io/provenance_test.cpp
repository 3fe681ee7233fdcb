// A program that has a table file and nothing else makes its distribution again and validates it.
#include <cmath>
#include <filesystem>
#include <random>
#include <string>

#include "support/catch.h"
#include "vndf/distributions/specification.h"
#include "vndf/io/table_file.h"
#include "vndf/kernel_tables.h"
#include "vndf/precompute/bake_certified.h"
#include "vndf/precompute/build_tables.h"
#include "vndf/validate/validate.h"

using namespace vndf;
using namespace vndf::distributions;

namespace {

struct Folder {
  std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("vndf-" + std::to_string(std::random_device{}()));
  Folder() { std::filesystem::create_directory(path); }
  ~Folder() { std::filesystem::remove_all(path); }
};

MeasuredProfile profile() {
  RadialProfile samples;
  for (double r = 0; r < 20; r = r * 1.1 + 0.02) {
    samples.r.push_back(r);
    samples.p22.push_back(std::pow(1 + r * r, -2));
  }
  return {"measured", samples, ProfileTail::power};
}

void check_same(const SlopeDistribution& made, const SlopeDistribution& original) {
  CHECK(made.name() == original.name());
  for (double r = 0; r < 1e3; r = r * 1.2 + 0.01) CHECK(made.p22(r) == original.p22(r));
}

void check_passes(const validate::SamplerUnderTest& sampler) {
  const validate::Verdict verdict = validate::validate_sampler(
      sampler, {.thoroughness = validate::Thoroughness::quick, .seed = 1});
  CHECK(verdict.passed());
}

}  // namespace

TEST_CASE("the library validates the tables of a profile from their file alone") {
  const Folder folder;
  const MeasuredProfile original = profile();
  const auto built = precompute::build_tables(original, {.layout = {64, 64, false}});
  const Provenance provenance{.specification = specify_profile(original)};
  for (const std::string name : {"t.h5", "t.exr"}) {
    CAPTURE(name);
    io::save(folder.path / name, {built.tables, provenance, built.certificate});
    const io::TableFile file = io::load(folder.path / name);
    CHECK(file.provenance == provenance);
    auto made = make_distribution(file.provenance.specification);
    check_same(*made, original);
    check_passes(
        validate::tables_under_test(name, std::make_shared<validate::ExactSlopes>(std::move(made)),
                                    file.tables, file.certificate));
  }
  const KernelTables baked =
      precompute::bake_certified(precompute::UnitSlopes(original, {}), *built.tables,
                                 {.tolerance = 1e-4}, {original.name(), provenance}, {});
  save(folder.path / "t.vndf", baked);
  const KernelTables loaded = load(folder.path / "t.vndf");
  CHECK(loaded.text().provenance == provenance);
  auto made = make_distribution(loaded.text().provenance.specification);
  check_same(*made, original);
  check_passes(validate::baked_tables_under_test(
      "t.vndf", std::make_shared<validate::ExactSlopes>(std::move(made)), loaded));
}
