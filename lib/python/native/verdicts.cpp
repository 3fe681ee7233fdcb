// The validator, with the text that the program prints and the object that it writes.
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <pybind11/stl.h>

#include "arrays.h"
#include "inputs.h"
#include "module.h"
#include "report/verdict_text.h"
#include "tables.h"
#include "vndf/validate/records.h"
#include "vndf/validate/sampler/named_samplers.h"
#include "vndf/validate/validate.h"
#include "vndf/validate/validate_records.h"

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

/// The samples that `check` is given, each of nine to fourteen numbers in double precision.
struct Samples {
  Vectors wi, wm;
  Surfaces surfaces;
  std::optional<RandomNumbers<2>> u;
  std::optional<Columns> pdf;
};

/// The numbers of a surface as people give them, in which records have them.
void set_surface(const RoughSurface<double>& surface, validate::Configuration& c) {
  const double along = surface.alpha().y, across = surface.shear() * surface.alpha().x;
  c.alpha = {surface.alpha().x, across == 0 ? along : std::hypot(across, along)};
  c.correlation = across / c.alpha.y;
  c.mean = surface.mean();
}

/// The samples as records. Throws std::invalid_argument, which names the first one that breaks a
/// rule.
validate::Records records_of(const Samples& samples) {
  const std::size_t count = samples.wi.columns().size();
  validate::Records records{{}, samples.u.has_value(), samples.pdf.has_value(), count};
  records.list.reserve(count);
  Block<double, 3> wi, wm;
  Block<double, 5> surfaces;
  Block<double, 2> u;
  Block<double, 1> pdf;
  for (std::size_t at = 0; at < count; at += kBlock) {
    const std::size_t n = std::min(kBlock, count - at);
    samples.wi.columns().read(at, n, wi);
    samples.wm.columns().read(at, n, wm);
    samples.surfaces.columns().read(at, n, surfaces);
    if (samples.u) samples.u->columns().read(at, n, u);
    if (samples.pdf) samples.pdf->read(at, n, pdf);
    for (std::size_t i = 0; i < n; ++i) {
      validate::Record record{{samples.wi.at(wi, i), {}}, samples.wm.at(wm, i)};
      set_surface(samples.surfaces.at(surfaces, i), record.configuration);
      auto rule = std::optional<std::string>();
      if (samples.u) {
        const auto [u1, u2] = samples.u->at(u, i);
        record.u1 = u1;
        record.u2 = u2;
        if (std::isnan(u1 + u2)) rule = "u1 and u2 must be numbers";
      }
      if (samples.pdf) record.pdf = pdf.columns[0][i];
      if (!rule) rule = validate::broken_rule(record);
      if (rule) throw std::invalid_argument("sample " + std::to_string(at + i) + ": " + *rule);
      records.list.push_back(record);
    }
  }
  return records;
}

validate::SampledNormals normals_of(const std::string& name) {
  using validate::SampledNormals;
  if (name == "visible") return SampledNormals::visible_smith;
  if (name == "v-cavity") return SampledNormals::visible_v_cavity;
  if (name == "all") return SampledNormals::all;
  throw std::invalid_argument("the normals are '" + name +
                              "'; they must be visible, v-cavity or all");
}

struct Claim {
  std::string normals;
  std::optional<bool> inverse;
  double u_error;
};

Report check(const std::string& name, const Source& against, const py::array& wi,
             const py::array& alpha, const py::array& wm, const std::optional<py::array>& u,
             const std::optional<py::array>& pdf, const Claim& claim, std::uint64_t seed,
             unsigned threads) {
  Samples samples{Vectors(wi), Vectors(wm), Surfaces(alpha), {}, {}};
  if (u) samples.u.emplace(*u);
  if (pdf) samples.pdf.emplace(*pdf);
  const validate::RecordOptions options{.normals = normals_of(claim.normals),
                                        .monotone_inverse = claim.inverse,
                                        .u_error = claim.u_error,
                                        .seed = seed,
                                        .workers = {threads}};
  const py::gil_scoped_release release;
  const auto records = records_of(samples);
  auto verdict = validate::validate_records(records, ExactSlopes(against.distribution()), options);
  verdict.sampler = name;
  return {tools::describe(verdict) + tools::conclusion(verdict), tools::to_json(verdict).dump()};
}

}  // namespace

void add_verdicts(py::module_& module) {
  py::class_<Claim>(module, "Claim").def(py::init<std::string, std::optional<bool>, double>());
  module.def("check", check);
  module.def("validate_tables", validate_tables);
  module.def("validate_reference", validate_reference);
}

}  // namespace vndf::python
