// BSDFs over arrays. The library fixes the number of colour channels when it is compiled; here it
// is that of an array, of which three are evaluated at a time.
#include <array>
#include <utility>
#include <vector>

#include <pybind11/stl.h>

#include "evaluate.h"
#include "inputs.h"
#include "module.h"
#include "normals.h"
#include "vndf/bsdf/conductor_brdf.h"
#include "vndf/bsdf/dielectric_bsdf.h"

namespace vndf::python {
namespace {

constexpr std::size_t kChannels = 3;

/// Calls f(sampler, masking) with `sampler` as the class of the library that its model asks for.
template <class T, class F>
void with_model(const Sampler& sampler, F f) {
  const Normals<T>& normals = sampler.in<T>();
  switch (sampler.model) {
    case Model::visible_v_cavity:
      return f(AnyNormals<T, Model::visible_v_cavity>(normals), VCavityMasking{});
    case Model::all:
      return f(AnyNormals<T, Model::all>(normals), SmithCorrelated{});
    default:
      return f(AnyNormals<T, Model::visible_smith>(normals), SmithCorrelated{});
  }
}

/// Real and imaginary parts of the refractive indices of all channels.
using Indices = std::vector<std::pair<double, double>>;

/// Those of the channels from `first` on. Beyond the last it is an index of 1, which reflects
/// nothing.
template <class T>
ConductorFresnel<T, kChannels> fresnel_of(const Indices& indices, std::size_t first) {
  ConductorFresnel<T, kChannels> fresnel{};
  for (std::size_t k = 0; k < kChannels; ++k) {
    const auto [eta, extinction] =
        first + k < indices.size() ? indices[first + k] : std::pair<double, double>{1, 0};
    fresnel.eta[k] = static_cast<T>(eta);
    fresnel.k[k] = static_cast<T>(extinction);
  }
  return fresnel;
}

/// The channels of an array of results [first, first + kChannels), as far as there are.
py::array channels_of(const py::array& array, std::size_t first) {
  const auto end = static_cast<py::ssize_t>(first + kChannels);
  return array[py::make_tuple(
      py::ellipsis(),
      py::slice(static_cast<py::ssize_t>(first), std::min(end, array.shape(array.ndim() - 1)), 1))];
}

template <class T, std::size_t N>
void put(std::array<T, N>& results, std::size_t at, const Vec3<T>& v) {
  results[at] = v.x;
  results[at + 1] = v.y;
  results[at + 2] = v.z;
}

void conductor_evaluate(const Sampler& sampler, const py::array& wi, const py::array& wo,
                        const py::array& alpha, const Indices& indices, const py::array& f_array,
                        unsigned threads) {
  for (std::size_t first = 0; first < indices.size(); first += kChannels) {
    py::array channels = channels_of(f_array, first);
    const Columns f = Columns::written(channels);
    in_precision_of(f, [&]<class T>(T) {
      const auto fresnel = fresnel_of<T>(indices, first);
      with_model<T>(sampler, [&](const auto& normals, const auto& masking) {
        for_each_sample<T, kChannels>(
            f.size(), threads, {{f}},
            [&](const Vec3<T>& i, const Vec3<T>& o, const RoughSurface<T>& surface) {
              return ConductorBrdf(normals, surface, fresnel, masking).evaluate(i, o);
            },
            Vectors(wi), Vectors(wo), Surfaces(alpha));
      });
    });
  }
}

void conductor_pdf(const Sampler& sampler, const py::array& wi, const py::array& wo,
                   const py::array& alpha, py::array pdf_array, unsigned threads) {
  const Columns pdf = Columns::written(pdf_array);
  in_precision_of(pdf, [&]<class T>(T) {
    with_model<T>(sampler, [&](const auto& normals, const auto& masking) {
      for_each_sample<T, 1>(
          pdf.size(), threads, {{pdf}},
          [&](const Vec3<T>& i, const Vec3<T>& o, const RoughSurface<T>& surface) {
            return std::array<T, 1>{
                ConductorBrdf(normals, surface, PerfectMirror<T>{}, masking).pdf(i, o)};
          },
          Vectors(wi), Vectors(wo), Surfaces(alpha));
    });
  });
}

void conductor_sample(const Sampler& sampler, const py::array& wi, const py::array& alpha,
                      const py::array& u, const Indices& indices, py::array wo_array,
                      const py::array& weight_array, py::array pdf_array, unsigned threads) {
  const Columns wo = Columns::written(wo_array), pdf = Columns::written(pdf_array);
  for (std::size_t first = 0; first < indices.size(); first += kChannels) {
    py::array channels = channels_of(weight_array, first);
    const Columns weight = Columns::written(channels);
    in_precision_of(wo, [&]<class T>(T) {
      const auto fresnel = fresnel_of<T>(indices, first);
      with_model<T>(sampler, [&](const auto& normals, const auto& masking) {
        for_each_sample<T, 7>(
            wo.size(), threads, {{wo}, {weight, 3}, {pdf, 6}},
            [&](const Vec3<T>& i, const RoughSurface<T>& surface, const std::array<T, 2>& v) {
              const auto drawn =
                  ConductorBrdf(normals, surface, fresnel, masking).sample(i, v[0], v[1]);
              std::array<T, 7> results;
              put(results, 0, drawn.wo);
              std::copy(drawn.weight.begin(), drawn.weight.end(), results.begin() + 3);
              results[6] = drawn.pdf;
              return results;
            },
            Vectors(wi), Surfaces(alpha), RandomNumbers<2>(u));
      });
    });
  }
}

/// Writes f(BSDF, wi, wo).
template <class F>
void dielectric(const Sampler& sampler, const py::array& wi, const py::array& wo,
                const py::array& alpha, double eta, py::array& result_array, unsigned threads,
                F f) {
  const Columns result = Columns::written(result_array);
  in_precision_of(result, [&]<class T>(T) {
    with_model<T>(sampler, [&](const auto& normals, const auto& masking) {
      for_each_sample<T, 1>(
          result.size(), threads, {{result}},
          [&](const Vec3<T>& i, const Vec3<T>& o, const RoughSurface<T>& surface) {
            return std::array<T, 1>{
                f(DielectricBsdf(normals, surface, static_cast<T>(eta), masking), i, o)};
          },
          Vectors(wi), Vectors(wo), Surfaces(alpha));
    });
  });
}

void dielectric_evaluate(const Sampler& sampler, const py::array& wi, const py::array& wo,
                         const py::array& alpha, double eta, py::array f, unsigned threads) {
  dielectric(sampler, wi, wo, alpha, eta, f, threads,
             [](const auto& bsdf, const auto& i, const auto& o) { return bsdf.evaluate(i, o); });
}

void dielectric_pdf(const Sampler& sampler, const py::array& wi, const py::array& wo,
                    const py::array& alpha, double eta, py::array pdf, unsigned threads) {
  dielectric(sampler, wi, wo, alpha, eta, pdf, threads,
             [](const auto& bsdf, const auto& i, const auto& o) { return bsdf.pdf(i, o); });
}

void dielectric_sample(const Sampler& sampler, const py::array& wi, const py::array& alpha,
                       const py::array& u, double eta, py::array wo_array, py::array weight_array,
                       py::array pdf_array, unsigned threads) {
  const Columns wo = Columns::written(wo_array), weight = Columns::written(weight_array),
                pdf = Columns::written(pdf_array);
  in_precision_of(wo, [&]<class T>(T) {
    with_model<T>(sampler, [&](const auto& normals, const auto& masking) {
      for_each_sample<T, 5>(
          wo.size(), threads, {{wo}, {weight, 3}, {pdf, 4}},
          [&](const Vec3<T>& i, const RoughSurface<T>& surface, const std::array<T, 3>& v) {
            const auto drawn = DielectricBsdf(normals, surface, static_cast<T>(eta), masking)
                                   .sample(i, v[0], v[1], v[2]);
            std::array<T, 5> results;
            put(results, 0, drawn.wo);
            results[3] = drawn.weight;
            results[4] = drawn.pdf;
            return results;
          },
          Vectors(wi), Surfaces(alpha), RandomNumbers<3>(u));
    });
  });
}

}  // namespace

void add_bsdfs(py::module_& module) {
  module.def("conductor_evaluate", conductor_evaluate);
  module.def("conductor_pdf", conductor_pdf);
  module.def("conductor_sample", conductor_sample);
  module.def("dielectric_evaluate", dielectric_evaluate);
  module.def("dielectric_pdf", dielectric_pdf);
  module.def("dielectric_sample", dielectric_sample);
}

}  // namespace vndf::python
