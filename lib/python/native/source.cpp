// Distributions from what a user of Python has: names, formulas, functions, arrays.
#include "source.h"

#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <map>
#include <optional>
#include <span>
#include <utility>

#include "vndf/distributions/diagnose.h"
#include "vndf/distributions/fit_profile.h"
#include "vndf/distributions/formula_distribution.h"
#include "vndf/distributions/measured_profile.h"
#include "vndf/distributions/slope_map.h"
#include "vndf/distributions/specification.h"
#include "vndf/io/map_image.h"

namespace vndf::python {

namespace py = pybind11;
using distributions::ProfileTail;

namespace {

/// p22(r) of a function of Python's, from any thread.
double value_at(const py::function& p22, double r) {
  const py::gil_scoped_acquire acquire;
  const double number = PyFloat_AsDouble(p22(r).ptr());
  if (PyErr_Occurred() != nullptr) throw py::error_already_set();
  return number;
}

}  // namespace

std::unique_ptr<distributions::SlopeDistribution> Source::distribution() const {
  if (!function) return distributions::make_distribution(specification);
  const auto call = [f = function](double r) { return value_at(*f, r); };
  auto made = std::make_unique<distributions::FormulaDistribution>(
      distributions::FormulaDistribution::from_function(name, call, breaks));
  diagnose(*made);
  return made;
}

ReleaseUnlessFunction::ReleaseUnlessFunction(const Source& source)
    : release_(source.function ? nullptr : std::make_unique<py::gil_scoped_release>()) {}
ReleaseUnlessFunction::~ReleaseUnlessFunction() = default;

namespace {

using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

Source of_family(const std::string& text, const std::string& name) {
  return {distributions::specify_family(text, name)};
}

/// Any of the grammar of specifications but a profile, whose samples are not in the text.
Source of_specification(const std::string& text) {
  return {{text}};
}

Source of_p22(const std::string& formula, const std::map<std::string, double>& parameters,
              const std::vector<double>& breaks, const std::string& name) {
  return {distributions::specify_p22({formula, parameters}, breaks, name)};
}

Source of_function(const py::function& p22, const std::vector<double>& breaks,
                   const std::string& name) {
  Source source;
  source.function = std::make_shared<const py::function>(p22);
  source.breaks = breaks;
  source.name = name;
  return source;
}

Source of_ndf(const std::string& formula, const std::map<std::string, double>& parameters,
              std::optional<double> frozen_at, const std::vector<double>& breaks,
              const std::string& name) {
  return {distributions::specify_ndf({formula, parameters}, frozen_at, breaks, name)};
}

std::vector<double> vector_of(const Numbers& array) {
  return {array.data(), array.data() + array.size()};
}

ProfileTail tail_of(const std::string& name) {
  if (name == "none") return ProfileTail::none;
  if (name == "exponential") return ProfileTail::exponential;
  if (name == "power") return ProfileTail::power;
  throw std::invalid_argument("the tail is '" + name + "'; it must be none, exponential or power");
}

std::string text_of(const distributions::TailFit& tail) {
  if (tail.kind == ProfileTail::none) return "tail: none, p22 is 0 beyond the last sample\n";
  return fmt::format("tail: {}, {:.2g} of the mass, fitted within {:.2g}\n",
                     tail.kind == ProfileTail::power
                         ? fmt::format("power, p22 ~ r^-{:.6g}", tail.parameter)
                         : fmt::format("exponential, p22 ~ exp(-{:.6g} r)", tail.parameter),
                     tail.fraction_of_mass_beyond, tail.residual);
}

std::string text_of(const char* what, const distributions::FitResidual& fit, std::size_t kept) {
  return fmt::format("{}: {} samples in place of {}, CDF of slopes within {:.1e}\n", what, kept,
                     fit.samples, fit.u_error);
}

Source of_profile(const Numbers& r, const Numbers& p22, const std::string& tail, bool smooth,
                  const std::string& name) {
  distributions::RadialProfile samples{vector_of(r), vector_of(p22)};
  std::string notes;
  if (smooth) {
    auto [fewer, residual] = distributions::smoothed(std::move(samples));
    notes = text_of("smoothed", residual, fewer.r.size());
    samples = std::move(fewer);
  }
  const distributions::MeasuredProfile profile(name, std::move(samples), tail_of(tail));
  if (const auto& residual = profile.resampling())
    notes += text_of("resampled", *residual, profile.samples().r.size());
  return {distributions::specify_profile(profile), notes + text_of(profile.tail())};
}

Source of_slopes(const io::SlopeImage& image, bool ignore_asymmetry, const std::string& name) {
  const auto estimate = distributions::estimate_slope_map(
      image.slopes, {.name = name, .ignore_asymmetry = ignore_asymmetry});
  const auto& s = estimate.statistics;
  return {distributions::specify_profile(*estimate.distribution),
          fmt::format("map: {}, {} x {} texels\n", image.content, image.width, image.height) +
              fmt::format("estimated: u-error below {:.2e} (95 %), asymmetry {:.3f} (bound "
                          "{:.3f})\n",
                          s.u_error, s.asymmetry, s.asymmetry_bound) +
              text_of(estimate.distribution->tail()),
          s.surface};
}

io::NormalEncoding encoding_of(const std::string& name) {
  if (name == "automatic") return io::NormalEncoding::automatic;
  if (name == "plain") return io::NormalEncoding::plain;
  if (name == "shifted") return io::NormalEncoding::shifted;
  throw std::invalid_argument("the encoding is '" + name +
                              "'; it must be automatic, plain or shifted");
}

/// A map whose pixels are in an array (height, width, channels) of float32.
Source of_map(const py::array_t<float, py::array::c_style>& array, bool whole_numbers,
              const std::string& encoding, bool ignore_asymmetry, const std::string& name) {
  io::MapPixels pixels;
  pixels.height = static_cast<std::size_t>(array.shape(0));
  pixels.width = static_cast<std::size_t>(array.shape(1));
  pixels.kind = array.shape(2) == 3 ? io::MapPixels::Kind::normals : io::MapPixels::Kind::slopes;
  pixels.format = "array";
  pixels.whole_numbers = whole_numbers;
  pixels.values.assign(array.data(), array.data() + array.size());
  const py::gil_scoped_release release;
  return of_slopes(io::slope_map_of(pixels, name, encoding_of(encoding)), ignore_asymmetry, name);
}

Source of_map_file(const std::string& path, const std::string& encoding, bool ignore_asymmetry,
                   const std::string& name) {
  const py::gil_scoped_release release;
  return of_slopes(io::read_slope_map(path, encoding_of(encoding)), ignore_asymmetry, name);
}

}  // namespace

void add_sources(py::module_& module) {
  py::class_<Source>(module, "Source");
  module.def("source_of_family", of_family);
  module.def("source_of_specification", of_specification);
  module.def("source_of_p22", of_p22);
  module.def("source_of_function", of_function);
  module.def("source_of_ndf", of_ndf);
  module.def("source_of_profile", of_profile);
  module.def("source_of_map", of_map);
  module.def("source_of_map_file", of_map_file);
}

}  // namespace vndf::python
