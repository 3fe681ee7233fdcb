// The validator, with the text that the program prints and the object that it writes.
#include <memory>
#include <string>
#include <utility>

#include <pybind11/stl.h>

#include "arrays.h"
#include "module.h"
#include "report/verdict_text.h"
#include "tables.h"
#include "vndf/validate/sampler/named_samplers.h"
#include "vndf/validate/validate.h"

namespace vndf::python {
namespace {

using validate::ExactSlopes;
using validate::Thoroughness;

Thoroughness thoroughness_of(const std::string& name) {
  if (name == "quick") return Thoroughness::quick;
  if (name == "standard") return Thoroughness::standard;
  if (name == "thorough") return Thoroughness::thorough;
  throw std::invalid_argument("the thoroughness is '" + name +
                              "'; it must be quick, standard or thorough");
}

/// The text of a verdict, and the same as JSON.
using Report = std::pair<std::string, std::string>;

Report report_of(const validate::Verdict& verdict) {
  return {tools::describe(verdict), tools::to_json(verdict).dump()};
}

validate::SamplerUnderTest under_test(const Tables& tables,
                                      std::shared_ptr<const ExactSlopes> exact) {
  const std::string name =
      tables.kernel ? tables.kernel->text().distribution : tables.pair->tables->distribution;
  if (tables.kernel)
    return validate::baked_tables_under_test(name, std::move(exact), *tables.kernel);
  return validate::tables_under_test(name, std::move(exact), tables.pair->tables,
                                     tables.pair->certificate);
}

Report validate_tables(const Tables& tables, const std::string& thoroughness, std::uint64_t seed,
                       unsigned threads) {
  const Source source = tables.source();
  const auto level = thoroughness_of(thoroughness);
  const py::gil_scoped_release release;  // the exact slopes are integrated on several threads
  const auto sampler =
      under_test(tables, std::make_shared<const ExactSlopes>(source.distribution()));
  return report_of(validate::validate_sampler(
      sampler, {.thoroughness = level, .seed = seed, .workers = {source.threads(threads)}}));
}

Report validate_reference(const std::string& name, const std::string& thoroughness,
                          std::uint64_t seed, unsigned threads) {
  const auto level = thoroughness_of(thoroughness);
  const py::gil_scoped_release release;
  const auto& named = validate::find_sampler(name);
  const auto sampler =
      named.make(name, std::make_shared<const ExactSlopes>(named.make_distribution()));
  return report_of(validate::validate_sampler(
      sampler, {.thoroughness = level, .seed = seed, .workers = {threads}}));
}

}  // namespace

void add_verdicts(py::module_& module) {
  module.def("validate_tables", validate_tables);
  module.def("validate_reference", validate_reference);
}

}  // namespace vndf::python
