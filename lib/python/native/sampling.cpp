// Sampling normals and evaluating their distribution, over arrays.
#include <algorithm>
#include <array>
#include <limits>
#include <span>

#include "evaluate.h"
#include "inputs.h"
#include "module.h"
#include "normals.h"
#include "vndf/batch/sample_batch.h"
#include "vndf/bsdf/masking.h"

namespace vndf::python {
namespace {

/// Draws a piece of an array by vectors, block by block.
class BatchOfKernel {
 public:
  BatchOfKernel(const Kernel& kernel, const Vectors& wi, const Surfaces& surfaces,
                const RandomNumbers<2>& u, const Columns& wm)
      : kernel_(kernel), wi_(wi), surfaces_(surfaces), u_(u), wm_(wm) {}

  void sample(std::size_t begin, std::size_t end) {
    const bool one_surface = surfaces_.columns().uniform();
    const bool one_direction = wi_.columns().uniform() && one_surface;
    wi_.columns().read(begin, 1, directions_);
    surfaces_.columns().read(begin, 1, alphas_);
    const RoughSurface<float> surface = surfaces_.at(alphas_, 0);
    const KernelDirection prepared = kernel_.at(wi_.at(directions_, 0), surface);
    for (std::size_t at = begin; at < end; at += kBlock) {
      const std::size_t n = std::min(kBlock, end - at);
      u_.columns().read(at, n, random_);
      if (!one_direction) wi_.columns().read(at, n, directions_);
      if (!one_surface) surfaces_.columns().read(at, n, alphas_);
      const auto u1 = column(random_, 0, n), u2 = column(random_, 1, n);
      const DirectionSpans wi{column(directions_, 0, n), column(directions_, 1, n),
                              column(directions_, 2, n)};
      const NormalSpans wm{target(0, n), target(1, n), target(2, n)};
      if (one_direction)
        sample_batch(prepared, u1, u2, wm);
      else if (one_surface)
        sample_batch(kernel_, wi, surface, u1, u2, wm);
      else
        sample_batch(kernel_, wi, {column(alphas_, 0, n), column(alphas_, 1, n)}, u1, u2, wm);
      wm_.write(at, n, normals_, 0);
    }
  }

 private:
  template <std::size_t K>
  static std::span<const float> column(const Block<float, K>& block, std::size_t k, std::size_t n) {
    return {block.columns[k].data(), n};
  }
  std::span<float> target(std::size_t k, std::size_t n) { return {normals_.columns[k].data(), n}; }

  const Kernel& kernel_;
  const Vectors& wi_;
  const Surfaces& surfaces_;
  const RandomNumbers<2>& u_;
  const Columns& wm_;
  Block<float, 3> directions_, normals_;
  Block<float, 5> alphas_;
  Block<float, 2> random_;
};

template <class T>
std::array<T, 3> numbers(const Vec3<T>& v) {
  return {v.x, v.y, v.z};
}

void sample(const Sampler& sampler, const py::array& wi_array, const py::array& alpha,
            const py::array& u_array, py::array wm_array, unsigned threads) {
  const Vectors wi(wi_array);
  const Surfaces surfaces(alpha);
  const RandomNumbers<2> u(u_array);
  const Columns wm = Columns::written(wm_array);
  // A batch takes many roughnesses, or one surface with correlation or a mean slope.
  if (sampler.kernel && !wm.in_double() && (surfaces.flat() || surfaces.columns().uniform())) {
    for_each_piece(wm.size(), threads, [&](std::size_t begin, std::size_t end) {
      BatchOfKernel(*sampler.kernel, wi, surfaces, u, wm).sample(begin, end);
    });
    return;
  }
  in_precision_of(wm, [&]<class T>(T) {
    const Normals<T>& normals = sampler.in<T>();
    for_each_sample<T, 3>(
        wm.size(), threads, {{wm}},
        [&](const Vec3<T>& w, const RoughSurface<T>& surface, const std::array<T, 2>& v) {
          return numbers(normals.sample(w, surface, v[0], v[1]));
        },
        wi, surfaces, u);
  });
}

void sample_with_density(const Sampler& sampler, const py::array& wi, const py::array& alpha,
                         const py::array& u, py::array wm_array, py::array density_array,
                         unsigned threads) {
  const Columns wm = Columns::written(wm_array), density = Columns::written(density_array);
  in_precision_of(wm, [&]<class T>(T) {
    const AnyNormals<T, Model::visible_smith> any(sampler.in<T>());
    for_each_sample<T, 4>(
        wm.size(), threads, {{wm}, {density, 3}},
        [&](const Vec3<T>& w, const RoughSurface<T>& surface, const std::array<T, 2>& v) {
          const auto drawn = OnSurface(any, surface).sample_with_density(w, v[0], v[1]);
          return std::array<T, 4>{drawn.wm.x, drawn.wm.y, drawn.wm.z, drawn.pdf};
        },
        Vectors(wi), Surfaces(alpha), RandomNumbers<2>(u));
  });
}

void invert(const Sampler& sampler, const py::array& wi, const py::array& wm,
            const py::array& alpha, py::array u_array, unsigned threads) {
  const Columns u = Columns::written(u_array);
  in_precision_of(u, [&]<class T>(T) {
    const AnyNormals<T, Model::visible_smith> any(sampler.in<T>());
    for_each_sample<T, 2>(
        u.size(), threads, {{u}},
        [&](const Vec3<T>& w, const Vec3<T>& m, const RoughSurface<T>& surface) {
          constexpr T kNone = std::numeric_limits<T>::quiet_NaN();
          const auto found = OnSurface(any, surface).invert(w, m).value_or(Vec2<T>{kNone, kNone});
          return std::array<T, 2>{found.x, found.y};
        },
        Vectors(wi), Vectors(wm), Surfaces(alpha));
  });
}

using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// The numbers that store surfaces, in place of those by which a user names them.
template <class Make>
Doubles stored(Doubles named, Make make) {
  for (double* n = named.mutable_data(); n != named.data() + named.size(); n += 5) {
    const RoughSurface<double> s = make(n, Vec2<double>{n[3], n[4]});
    const std::array<double, 5> numbers{s.alpha().x, s.alpha().y, s.shear(), s.mean().x,
                                        s.mean().y};
    std::copy(numbers.begin(), numbers.end(), n);
  }
  return named;
}

/// Writes f(sampler on a surface, ...) of the directions `w`.
template <class F, class... W>
void evaluate(const Sampler& sampler, const py::array& alpha, py::array& result_array,
              unsigned threads, F f, const W&... w) {
  const Columns result = Columns::written(result_array);
  in_precision_of(result, [&]<class T>(T) {
    const AnyNormals<T, Model::visible_smith> any(sampler.in<T>());
    for_each_sample<T, 1>(
        result.size(), threads, {{result}},
        [&](const RoughSurface<T>& surface, const auto&... direction) {
          return std::array<T, 1>{f(OnSurface(any, surface), direction...)};
        },
        Surfaces(alpha), Vectors(w)...);
  });
}

void pdf(const Sampler& sampler, const py::array& wi, const py::array& wm, const py::array& alpha,
         py::array result, unsigned threads) {
  evaluate(
      sampler, alpha, result, threads,
      [](const auto& on, const auto& w, const auto& m) { return on.pdf(w, m); }, wi, wm);
}

void d(const Sampler& sampler, const py::array& wm, const py::array& alpha, py::array result,
       unsigned threads) {
  evaluate(
      sampler, alpha, result, threads, [](const auto& on, const auto& m) { return on.d(m); }, wm);
}

void lambda(const Sampler& sampler, const py::array& w, const py::array& alpha, py::array result,
            unsigned threads) {
  evaluate(
      sampler, alpha, result, threads, [](const auto& on, const auto& v) { return on.lambda(v); },
      w);
}

void g1(const Sampler& sampler, const py::array& w, const py::array& alpha, py::array result,
        unsigned threads) {
  evaluate(
      sampler, alpha, result, threads, [](const auto& on, const auto& v) { return on.g1(v); }, w);
}

template <class Masking>
void g2_of(const Sampler& sampler, const py::array& wi, const py::array& wo, const py::array& wm,
           const py::array& alpha, py::array& result, unsigned threads) {
  evaluate(
      sampler, alpha, result, threads,
      [](const auto& on, const auto& i, const auto& o, const auto& m) {
        return vndf::g2<Masking>(on.sampler(), on.direction(i), on.direction(o), on.normal(m).unit,
                                 on.surface().alpha());
      },
      wi, wo, wm);
}

void g2(const Sampler& sampler, const py::array& wi, const py::array& wo, const py::array& wm,
        const py::array& alpha, py::array result, unsigned threads) {
  if (sampler.model == Model::visible_v_cavity)
    g2_of<VCavityMasking>(sampler, wi, wo, wm, alpha, result, threads);
  else
    g2_of<SmithCorrelated>(sampler, wi, wo, wm, alpha, result, threads);
}

}  // namespace

void add_sampling(py::module_& module) {
  py::class_<Sampler>(module, "Sampler").def_property_readonly("in_double", [](const Sampler& s) {
    return s.in_double != nullptr;
  });
  module.def("correlated_surface", [](const Doubles& named) {
    return stored(named.attr("copy")(), [](const double* n, const Vec2<double>& mean) {
      return RoughSurface<double>::correlated({n[0], n[1]}, n[2], mean);
    });
  });
  module.def("surface_of_covariance", [](const Doubles& named) {
    return stored(named.attr("copy")(), [](const double* n, const Vec2<double>& mean) {
      return RoughSurface<double>::from_covariance(n[0], n[1], n[2], mean);
    });
  });
  module.def("turned_surface", [](const Doubles& named) {
    return stored(named.attr("copy")(), [](const double* n, const Vec2<double>& mean) {
      return RoughSurface<double>::turned({n[0], n[1]}, n[2], mean);
    });
  });
  module.def("sample", sample);
  module.def("sample_with_density", sample_with_density);
  module.def("invert", invert);
  module.def("pdf", pdf);
  module.def("d", d);
  module.def("lambda_", lambda);
  module.def("g1", g1);
  module.def("g2", g2);
}

}  // namespace vndf::python
