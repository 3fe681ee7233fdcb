// A walk inside the microsurface (Heitz, Hanika, d'Eon and Dachsbacher 2016): light that is masked
// hits another facet, and another, until it leaves. Each facet is a visible normal of the direction
// that the light comes from, which is soon below the horizon. The program weighs the light that
// leaves a white mirror in every direction, at one facet and at all: the first misses what is
// masked, and the second must be 1.
//
//   example_microsurface_walk TABLES ALPHA DEGREES WALKS
#include <array>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <numbers>
#include <random>

#include "vndf/bsdf/conductor_brdf.h"
#include "vndf/kernel_tables.h"

namespace {

using Vec = vndf::Vec3<float>;

struct NoLoss {
  std::array<float, 1> operator()(float) const { return {1.0f}; }
};

/// Random numbers, heights uniform in [0, 1] and white facets.
class Walk {
 public:
  Walk(const vndf::Kernel& kernel, float alpha)
      : kernel_(kernel), alpha_{alpha, alpha}, brdf_(kernel_, alpha_, NoLoss{}) {}

  /// What leaves along one direction, over the density with which that was drawn: at the first
  /// facet, and at all.
  std::array<double, 2> estimate(const Vec& wi) {
    const Vec wo = outgoing(wi);
    if (!(wo.z > 0)) return {};  // one facet reflects it down
    const double density =
        0.5 * double{brdf_.pdf(wi, wo)} + 0.5 * double{wo.z} * std::numbers::inv_pi;
    std::array<double, 2> sum{};
    Vec towards{-wi.x, -wi.y, -wi.z};  // where the light goes
    float height = 1;
    for (int facet = 0; facet < 1000; ++facet) {
      height = next_height(towards, height);
      if (height >= 1) break;
      const Vec from{-towards.x, -towards.y, -towards.z};
      const double light = double{scattered(from, wo)} * double{open(wo, height)} / density;
      if (facet == 0) sum[0] = light;
      sum[1] += light;
      towards = vndf::reflect(from, kernel_.sample(from, alpha_, uniform(), uniform()));
    }
    return sum;
  }

 private:
  float uniform() { return static_cast<float>(random_() >> 8) * 0x1p-24f; }

  /// Half of the directions are those that one facet reflects, and half are those of a diffuse
  /// surface, so that none is missed.
  Vec outgoing(const Vec& wi) {
    if (uniform() < 0.5f) return brdf_.sample(wi, uniform(), uniform()).wo;
    const float z = std::sqrt(1 - uniform()), r = std::sqrt(1 - z * z);
    const float phi = 2 * std::numbers::pi_v<float> * uniform();
    return {r * std::cos(phi), r * std::sin(phi), z};
  }

  /// Lambda, also of a direction that goes down, where it is -1 - Lambda of its mirror.
  float lambda(const Vec& w) const {
    const float above = kernel_.lambda(w, alpha_);
    return w.z < 0 ? -1 - above : above;
  }

  /// The chance that light leaves from `height` along w.
  float open(const Vec& w, float height) const { return std::pow(height, lambda(w)); }

  /// The height of the next facet along w, or 1 if there is none (Heitz et al. 2016, equation 27).
  float next_height(const Vec& w, float height) {
    const float chance = 1 - uniform();  // in (0, 1]
    if (w.z > 0 && chance < open(w, height)) return 1;
    return height / std::pow(chance, 1 / lambda(w));
  }

  /// Density with which a visible facet reflects light from `from` to `to`.
  float scattered(const Vec& from, const Vec& to) const {
    const Vec m = vndf::normalize_or_up(Vec{from.x + to.x, from.y + to.y, from.z + to.z});
    if (!(m.z > 0)) return 0;
    return vndf::outgoing_density(kernel_.pdf(from, m, alpha_),
                                  vndf::reflection_jacobian(vndf::dot(from, m)));
  }

  vndf::Kernel kernel_;
  vndf::Alpha<float> alpha_;
  vndf::ConductorBrdf<vndf::Kernel, NoLoss> brdf_;
  std::mt19937 random_{1};
};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 5) {
    std::cerr << "usage: example_microsurface_walk TABLES ALPHA DEGREES WALKS\n";
    return 2;
  }
  const vndf::KernelTables tables = vndf::load(argv[1]);
  const float angle = std::strtof(argv[3], nullptr) * std::numbers::pi_v<float> / 180;
  const long walks = std::strtol(argv[4], nullptr, 10);
  Walk walk(tables.kernel(), std::strtof(argv[2], nullptr));
  std::array<double, 2> sum{}, squares{};
  for (long i = 0; i < walks; ++i) {
    const auto light = walk.estimate({std::sin(angle), 0, std::cos(angle)});
    for (std::size_t k = 0; k < 2; ++k) {
      sum[k] += light[k];
      squares[k] += light[k] * light[k];
    }
  }
  const auto count = static_cast<double>(walks);
  for (std::size_t k = 0; k < 2; ++k) {
    const double mean = sum[k] / count;
    std::cout << (k == 0 ? "one facet  " : "all facets ") << mean << " +- "
              << std::sqrt((squares[k] / count - mean * mean) / count) << '\n';
  }
}
