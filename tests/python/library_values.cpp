// What the C++ library gives for the inputs of a Python test, for a comparison bit for bit, and how
// long a batch takes.
//
//   vndf_library_values values BAKED PAIR INPUTS RESULTS
//   vndf_library_values time BAKED INPUTS ROUNDS
//
// INPUTS are lines of nine numbers: wi, alpha, u1, u2 and, for other directions, wo: float64 in the
// order of the machine, [wi 3, wo 3, alpha 2, u 3]. RESULTS are, for each, the columns that
// values() lists, of the baked tables in single precision and then of the pair in double, all as
// float64. `time` prints the milliseconds of each round, from one direction and from all.
#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "vndf/batch/sample_batch.h"
#include "vndf/bsdf/conductor_brdf.h"
#include "vndf/bsdf/dielectric_bsdf.h"
#include "vndf/bsdf/masking.h"
#include "vndf/io/table_file.h"
#include "vndf/kernel_tables.h"
#include "vndf/on_surface.h"
#include "vndf/tabulated_sampler.h"

namespace {

using vndf::Vec2;
using vndf::Vec3;

struct Input {
  double wi[3], wo[3], alpha[2], u[3];
};

std::vector<Input> read_inputs(const char* path) {
  std::ifstream file(path, std::ios::binary);
  const std::vector<char> bytes{std::istreambuf_iterator<char>(file), {}};
  std::vector<Input> inputs(bytes.size() / sizeof(Input));
  std::copy_n(bytes.data(), inputs.size() * sizeof(Input), reinterpret_cast<char*>(inputs.data()));
  return inputs;
}

class Results {
 public:
  template <class T>
  void add(T v) {
    values_.push_back(static_cast<double>(v));
  }
  template <class T>
  void add(const Vec3<T>& v) {
    add(v.x);
    add(v.y);
    add(v.z);
  }
  void write(const char* path) const {
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(values_.data()),
               static_cast<std::streamsize>(values_.size() * sizeof(double)));
  }

 private:
  std::vector<double> values_;
};

template <class T>
Vec3<T> vector(const double (&v)[3]) {
  return {static_cast<T>(v[0]), static_cast<T>(v[1]), static_cast<T>(v[2])};
}

/// The columns of one sampler for one input.
template <class T, class Sampler>
void add_values(const Sampler& sampler, const Input& in, Results& results) {
  const Vec3<T> wi = vector<T>(in.wi), wo = vector<T>(in.wo);
  const vndf::Alpha<T> alpha{static_cast<T>(in.alpha[0]), static_cast<T>(in.alpha[1])};
  const Vec3<T> u = vector<T>(in.u);
  const Vec3<T> wm = sampler.sample(wi, alpha, u.x, u.y);
  results.add(wm);
  results.add(sampler.pdf(wi, wm, alpha));
  results.add(sampler.d(wm, alpha));
  results.add(sampler.lambda(wi, alpha));
  results.add(sampler.g1(wi, alpha));
  results.add(vndf::g2<vndf::SmithCorrelated>(sampler, wi, wo, wm, alpha));
  const auto drawn = sampler.sample_with_density(wi, alpha, u.x, u.y);
  results.add(drawn.wm);
  results.add(drawn.pdf);
  const Vec2<T> inverse = sampler.invert(wi, wm, alpha).value_or(Vec2<T>{-1, -1});
  results.add(inverse.x);
  results.add(inverse.y);
  const vndf::RoughSurface<T> surface(
      vndf::RoughSurface<double>::correlated({in.alpha[0], in.alpha[1]}, 0.5, {0.1, -0.2}));
  const vndf::OnSurface on(sampler, surface);
  const Vec3<T> tilted = on.sample(wi, u.x, u.y);
  results.add(tilted);
  results.add(on.pdf(wi, tilted));
  results.add(on.d(tilted));
  results.add(on.lambda(wi));
  const vndf::ConductorFresnel<T, 2> fresnel{{T(0.2), T(1.5)}, {T(3), T(2)}};
  const vndf::ConductorBrdf metal(sampler, surface, fresnel);
  const auto reflected = metal.sample(wi, u.x, u.y);
  results.add(reflected.wo);
  results.add(reflected.weight[0]);
  results.add(reflected.weight[1]);
  results.add(reflected.pdf);
  results.add(metal.evaluate(wi, wo)[1]);
  results.add(metal.pdf(wi, wo));
  const vndf::DielectricBsdf glass(sampler, alpha, T(1.5));
  const auto scattered = glass.sample(wi, u.x, u.y, u.z);
  results.add(scattered.wo);
  results.add(scattered.weight);
  results.add(scattered.pdf);
  results.add(glass.evaluate(wi, wo));
  results.add(glass.pdf(wi, wo));
}

void write_values(const char* baked, const char* pair, const char* inputs, const char* path) {
  const auto tables = vndf::load(baked);
  const vndf::Kernel kernel = tables.kernel();
  const vndf::TabulatedSampler<double> in_double(vndf::io::load(pair).tables);
  Results results;
  for (const Input& in : read_inputs(inputs)) {
    add_values<float>(kernel, in, results);
    add_values<double>(in_double, in, results);
  }
  results.write(path);
}

/// Milliseconds that `run` takes.
template <class Run>
double milliseconds(Run run) {
  const auto start = std::chrono::steady_clock::now();
  run();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
      .count();
}

void print_times(const char* baked, const char* path, int rounds) {
  const auto tables = vndf::load(baked);
  const vndf::Kernel kernel = tables.kernel();
  const std::vector<Input> inputs = read_inputs(path);
  const std::size_t n = inputs.size();
  const auto column = [&](auto number) {
    std::vector<float> values(n);
    std::transform(inputs.begin(), inputs.end(), values.begin(),
                   [&](const Input& in) { return static_cast<float>(number(in)); });
    return values;
  };
  const auto wx = column([](const Input&in) { return in.wi[0]; }),
             wy = column([](const Input&in) { return in.wi[1]; }),
             wz = column([](const Input&in) { return in.wi[2]; }),
             ax = column([](const Input&in) { return in.alpha[0]; }),
             ay = column([](const Input&in) { return in.alpha[1]; }),
             u1 = column([](const Input&in) { return in.u[0]; }),
             u2 = column([](const Input&in) { return in.u[1]; });
  std::vector<float> x(n), y(n), z(n);
  const auto one = kernel.at({wx[0], wy[0], wz[0]}, {ax[0], ay[0]});
  for (int round = 0; round < rounds; ++round) {
    const double from_one = milliseconds([&] { sample_batch(one, u1, u2, {x, y, z}); });
    const double from_all = milliseconds([&] {
      sample_batch(kernel, {wx, wy, wz}, {ax, ay}, u1, u2, {x, y, z});
    });
    std::cout << from_one << ' ' << from_all << '\n';
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 6 && std::string_view(argv[1]) == "values") {
    write_values(argv[2], argv[3], argv[4], argv[5]);
    return 0;
  }
  if (argc == 5 && std::string_view(argv[1]) == "time") {
    print_times(argv[2], argv[3], std::atoi(argv[4]));
    return 0;
  }
  std::cerr << "see the first lines of library_values.cpp\n";
  return 2;
}
