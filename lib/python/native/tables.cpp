// Tables: built, baked, loaded, saved, and what is known of them.
#include "tables.h"

#include <pybind11/stl.h>

#include <array>
#include <span>
#include <string>
#include <string_view>

#include "module.h"
#include "report/report.h"
#include "vndf/precompute/bake_certified.h"
#include "vndf/precompute/build_tables.h"
#include "vndf/tabulated_sampler.h"
#include "vndf/version.h"

namespace vndf::python {

namespace py = pybind11;

Sampler Tables::sampler() const {
  Sampler sampler;
  if (pair) {
    const auto& tables = pair->tables;
    sampler.in_single =
        std::make_shared<NormalsOf<TabulatedSampler<float>>>(TabulatedSampler<float>(tables));
    sampler.in_double =
        std::make_shared<NormalsOf<TabulatedSampler<double>>>(TabulatedSampler<double>(tables));
  }
  if (kernel) {
    sampler.kernel = kernel->kernel();
    sampler.in_single = std::make_shared<NormalsOf<Kernel>>(*sampler.kernel);
    sampler.owner = std::make_shared<KernelTables>(*kernel);
  }
  return sampler;
}

Source Tables::source() const {
  if (built_from) return *built_from;
  return {kernel ? kernel->text().provenance.specification : pair->provenance.specification};
}

namespace {

struct Baking {
  double tolerance;
  std::size_t max_bytes;
  bool below_horizon;

  BakeOptions options() const { return {tolerance, max_bytes, below_horizon}; }
};

/// Bakes the pair of `tables`, against the distribution of `source`.
void bake_from(const Source& source, const distributions::SlopeDistribution& distribution,
               const Baking& baking, unsigned threads, Tables& tables) {
  const support::Workers workers{source.threads(threads)};
  tables.kernel = precompute::bake_certified(
      precompute::UnitSlopes(distribution, workers), *tables.pair->tables, baking.options(),
      {tables.pair->tables->distribution, tables.pair->provenance}, workers);
}

struct Size {
  std::size_t rows, columns;
  bool in_double;
};

Tables build(const Source& source, const Size& size, const std::optional<Baking>& baking,
             const std::string& command, unsigned threads) {
  const ReleaseUnlessFunction release(source);
  const auto distribution = source.distribution();
  const auto built = precompute::build_tables(
      *distribution,
      {.layout = {size.rows, size.columns, size.in_double}, .threads = source.threads(threads)});
  Tables tables;
  tables.built_from = source;
  tables.pair = {built.tables,
                 {source.specification, command, "vndf " VNDF_VERSION " (Python)", source.notes,
                  source.surface},
                 built.certificate};
  if (baking) bake_from(source, *distribution, *baking, threads, tables);
  return tables;
}

/// The pair of `tables` with tables baked from it.
Tables bake(const Tables& tables, const Baking& baking, unsigned threads) {
  if (!tables.pair)
    throw std::invalid_argument(
        "these are baked tables without the pair that they were baked from; load the pair, a .h5 "
        "or .exr file, or build the tables again");
  const Source source = tables.source();
  const ReleaseUnlessFunction release(source);
  Tables baked{tables.pair, {}, tables.built_from};
  if (source.function || !source.specification.text.empty())
    bake_from(source, *source.distribution(), baking, threads, baked);
  else
    baked.kernel = precompute::bake_uncertified(
        *tables.pair->tables, tables.pair->certificate, baking.options(),
        {tables.pair->tables->distribution, tables.pair->provenance});
  return baked;
}

std::span<const std::byte> bytes_of(std::string_view text) {
  return {reinterpret_cast<const std::byte*>(text.data()), text.size()};
}

Tables of_bytes(std::string_view bytes) {
  const py::gil_scoped_release release;
  if (bytes.starts_with(kKernelMagic)) return {{}, KernelTables::copy(bytes_of(bytes))};
  return {io::from_bytes(bytes, "the bytes")};
}

Tables of_file(const std::string& path) {
  const py::gil_scoped_release release;
  if (is_kernel_file(path)) return {{}, load(path)};
  return {io::load(path)};
}

py::bytes bytes_of_kernel(const Tables& tables, bool with_text) {
  const KernelTables kernel = with_text ? *tables.kernel : tables.kernel->with_text({});
  const auto bytes = kernel.bytes();
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

py::bytes bytes_of_pair(const Tables& tables) {
  return io::to_bytes(io::Format::hdf5, *tables.pair, "the pair");
}

/// What bytes_of_pair() and bytes_of_kernel() gave of the parts that were there.
Tables of_parts(const std::optional<std::string>& pair, const std::optional<std::string>& kernel) {
  const py::gil_scoped_release release;
  Tables tables;
  if (pair) tables.pair = io::from_bytes(*pair, "the pair");
  if (kernel) tables.kernel = KernelTables::copy(bytes_of(*kernel));
  return tables;
}

/// Calls `save`, whose failures are those of a file.
template <class Save>
void as_os_error(Save save) {
  try {
    const py::gil_scoped_release release;
    save();
  } catch (const std::runtime_error& error) {
    PyErr_SetString(PyExc_OSError, error.what());
    throw py::error_already_set();
  }
}

void save_kernel(const Tables& tables, const std::string& path) {
  as_os_error([&] { save(path, *tables.kernel); });
}

void save_pair(const Tables& tables, const std::string& path) {
  as_os_error([&] { io::save(path, *tables.pair); });
}

py::dict dict_of(const Certificate& certificate) {
  py::dict figures;
  for_each_figure(certificate,
                  [&](const std::string& name, double value) { figures[py::str(name)] = value; });
  return figures;
}

Provenance provenance_of(const Tables& tables) {
  return tables.kernel ? tables.kernel->text().provenance : tables.pair->provenance;
}

/// Roughness along x and y, correlation and mean slope, if tables are of a map.
std::optional<std::array<double, 5>> surface_of(const Tables& tables) {
  const auto surface = provenance_of(tables).surface;
  if (!surface) return {};
  return {
      {surface->alpha.x, surface->alpha.y, surface->correlation, surface->mean.x, surface->mean.y}};
}

}  // namespace

void add_tables(py::module_& module) {
  add_sources(module);
  py::class_<Baking>(module, "Baking").def(py::init<double, std::size_t, bool>());
  py::class_<Size>(module, "Size").def(py::init<std::size_t, std::size_t, bool>());
  py::class_<Tables>(module, "Tables")
      .def("sampler", &Tables::sampler)
      .def("source", &Tables::source)
      .def("bytes_of_kernel", bytes_of_kernel)
      .def("bytes_of_pair", bytes_of_pair)
      .def_property_readonly("has_kernel", [](const Tables& t) { return t.kernel.has_value(); })
      .def_property_readonly("has_pair", [](const Tables& t) { return t.pair.has_value(); })
      .def_property_readonly("certificate_of_kernel",
                             [](const Tables& t) { return dict_of(t.kernel->certificate()); })
      .def_property_readonly("certificate_of_pair",
                             [](const Tables& t) { return dict_of(t.pair->certificate); })
      .def_property_readonly("distribution",
                             [](const Tables& t) {
                               return t.kernel ? t.kernel->text().distribution
                                               : t.pair->tables->distribution;
                             })
      .def_property_readonly("specification",
                             [](const Tables& t) { return t.source().specification.text; })
      .def_property_readonly("notes", [](const Tables& t) { return provenance_of(t).notes; })
      .def_property_readonly("surface", surface_of)
      .def("describe_kernel", [](const Tables& t) { return tools::describe(*t.kernel); })
      .def("describe_pair", [](const Tables& t) { return tools::describe(*t.pair); });
  module.def("build", build);
  module.def("bake", bake);
  module.def("save_kernel", save_kernel);
  module.def("save_pair", save_pair);
  module.def("tables_of_bytes", of_bytes);
  module.def("tables_of_file", of_file);
  module.def("tables_of_parts", of_parts);
}

}  // namespace vndf::python
