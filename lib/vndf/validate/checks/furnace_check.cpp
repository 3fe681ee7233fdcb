// Furnace check: conservation of area and of energy.
#include "vndf/validate/checks/furnace_check.h"

#include <algorithm>
#include <cmath>

#include "vndf/bsdf/scatter.h"
#include "vndf/validate/checks/configurations.h"
#include "vndf/validate/checks/worst_over.h"
#include "vndf/validate/exact/normal_quadrature.h"
#include "vndf/validate/statistics/quasi_random.h"

namespace vndf::validate {
namespace {

constexpr const char* kCheck = "furnace";

/// Integral of D(wm) times `factor(wm)` over the nodes.
template <class F>
double integral(const SamplerUnderTest& sampler, const Configuration& c,
                const NormalQuadrature& nodes, F factor) {
  std::vector<double> d(nodes.wm.size());
  sampler.d(c.surface(), nodes.wm, d);
  double sum = 0;
  for (std::size_t k = 0; k < d.size(); ++k) sum += d[k] * nodes.weight[k] * factor(nodes.wm[k]);
  return sum;
}

double projected_area_error(const SamplerUnderTest& sampler, const Configuration& c) {
  const auto nodes = normal_quadrature(*sampler.exact, SampledNormals::all, c);
  return std::abs(integral(sampler, c, nodes, [](const auto& m) { return m.z; }) - nodes.covered);
}

/// Above the surface all facets show height / G1, and below it those that are seen height Lambda.
double visible_area_error(const SamplerUnderTest& sampler, const Configuration& c) {
  const auto nodes = normal_quadrature(*sampler.exact, SampledNormals::visible_smith, c);
  const double area =
      integral(sampler, c, nodes, [&](const auto& m) { return std::max(0.0, dot(c.wi, m)); });
  const double height = c.height();
  const double own = height > 0 ? height / sampler.g1(c) : -height * sampler.lambda(c);
  return without_height_rounding(std::abs(area / own - nodes.covered), c);
}

/// `w` on the other side of the mean facet, as high above it.
Vec3<double> mirrored(const Vec3<double>& w, const ExactSurface& surface) {
  return {w.x, w.y, w.z - 2 * surface.height(w)};
}

/// Compares G2 both ways between the direction of `c` and all others, above and below the surface,
/// for a few facets that are seen from it.
void see_reciprocity(const SamplerUnderTest& sampler, const Configuration& c,
                     const std::vector<Configuration>& others, Worst& worst) {
  constexpr std::size_t kFacets = 16;
  std::vector<RandomPair> u(kFacets);
  for (std::size_t k = 0; k < kFacets; ++k) u[k] = quasi_random_point(k);
  std::vector<Vec3<double>> wm(kFacets);
  sampler.sample(c, u, wm);
  const ExactSurface surface = c.surface();
  for (const Configuration& other : others)
    for (const Vec3<double>& wo : {other.wi, mirrored(other.wi, surface)})
      for (std::size_t k = 0; k < kFacets; ++k) {
        const double forth = sampler.g2(surface, c.wi, wo, wm[k]);
        const double back = sampler.g2(surface, wo, c.wi, wm[k]);
        worst.see(std::abs(forth - back), place_of(c, u[k].x, u[k].y));
      }
}

/// Outgoing directions, each with the solid angle that it stands for.
struct Outgoing {
  std::vector<Vec3<double>> wo;
  std::vector<double> weight;

  void add(const Vec3<double>& w, double solid_angle) {
    if (!(solid_angle > 0)) return;
    wo.push_back(w);
    weight.push_back(solid_angle);
  }
};

/// The directions into which the facets of `nodes` reflect.
Outgoing reflected(const Configuration& c, const NormalQuadrature& nodes) {
  Outgoing out;
  const ExactSurface surface = c.surface();
  for (std::size_t k = 0; k < nodes.wm.size(); ++k) {
    const double cosine = dot(c.wi, nodes.wm[k]);
    const auto wo = reflect(c.wi, nodes.wm[k]);
    if (cosine > 0 && surface.height(wo) > 0)
      out.add(wo, nodes.weight[k] * reflection_jacobian(cosine));
  }
  return out;
}
/// The directions into which the facets of `nodes`, of glass, refract.
Outgoing refracted(const Configuration& c, const NormalQuadrature& nodes) {
  Outgoing out;
  const ExactSurface surface = c.surface();
  for (std::size_t k = 0; k < nodes.wm.size(); ++k) {
    const double cosine = dot(c.wi, nodes.wm[k]);
    const auto wo = refract(c.wi, nodes.wm[k], kGlassIndex);
    if (cosine > 0 && wo && surface.height(*wo) < 0)
      out.add(*wo,
              nodes.weight[k] * refraction_jacobian(cosine, dot(*wo, nodes.wm[k]), kGlassIndex));
  }
  return out;
}

/// The energy that `bsdf` sends into the directions `out`.
template <class Bsdf>
double energy(const Bsdf& bsdf, const Configuration& c, const Outgoing& out) {
  std::vector<double> f(out.wo.size());
  bsdf(c, out.wo, f);
  double sum = 0;
  for (std::size_t k = 0; k < f.size(); ++k) sum += f[k] * out.weight[k];
  return sum;
}

/// Energy that is sent out beyond what comes in.
struct Excess {
  Worst mirror, glass;

  void see(const Excess& o) { see_each(std::tie(mirror, glass), std::tie(o.mirror, o.glass)); }
};

bool is_smith(const SamplerUnderTest& sampler) {
  return sampler.claims.normals != SampledNormals::visible_v_cavity;
}

void see_energy(const SamplerUnderTest& sampler, const Configuration& c, Excess& excess) {
  // Where all normals are drawn, too, only those that are seen scatter light.
  const auto nodes = normal_quadrature(
      *sampler.exact,
      is_smith(sampler) ? SampledNormals::visible_smith : SampledNormals::visible_v_cavity, c);
  const Outgoing up = reflected(c, nodes), down = refracted(c, nodes);
  const double mirror = energy(sampler.mirror, c, up);
  const double glass = energy(sampler.glass, c, up) + energy(sampler.glass, c, down);
  // An energy that is not a number stays so, and fails.
  excess.mirror.see(mirror <= 1 ? 0 : mirror - 1, place_of(c));
  excess.glass.see(glass <= 1 ? 0 : glass - 1, place_of(c));
}

/// All that is measured at one configuration.
struct FurnaceErrors {
  Worst projected, visible, reciprocity;
  Excess excess;

  void see(const FurnaceErrors& o) {
    see_each(std::tie(projected, visible, reciprocity, excess),
             std::tie(o.projected, o.visible, o.reciprocity, o.excess));
  }
};

/// From below only the visible area is measured: BSDFs are those of facets that are seen from
/// above.
FurnaceErrors measure(const SamplerUnderTest& sampler, const Configuration& c,
                      const std::vector<Configuration>& above) {
  FurnaceErrors errors;
  if (is_smith(sampler) && c.height() != 0)
    errors.visible.see(visible_area_error(sampler, c), place_of(c));
  if (c.height() < 0) return errors;
  errors.projected.see(projected_area_error(sampler, c), place_of(c));
  see_reciprocity(sampler, c, above, errors.reciprocity);
  see_energy(sampler, c, errors.excess);
  return errors;
}

}  // namespace

std::vector<CheckResult> check_furnace(const SamplerUnderTest& sampler,
                                       const support::Workers& workers) {
  const auto list = check_configurations(sampler);
  const auto above = side_above(sampler, list).list;
  const FurnaceErrors all =
      worst_over(list, workers, [&](const Configuration& c) { return measure(sampler, c, above); });
  const double bound = sampler.bounds.function_error;
  std::vector<CheckResult> results{all.projected.result(kCheck, "projected area - 1", bound)};
  if (is_smith(sampler))
    results.push_back(all.visible.result(kCheck, "weak white furnace - 1", bound));
  results.push_back(all.reciprocity.result(kCheck, "reciprocity of G2", kReciprocityError));
  results.push_back(all.excess.mirror.result(kCheck, "energy of a mirror over 1", bound));
  results.push_back(all.excess.glass.result(kCheck, "energy of glass over 1", bound));
  return results;
}

}  // namespace vndf::validate
