// Stage: conservation of area and of energy.
#include "vndf/validate/checks/furnace_check.h"

#include <algorithm>
#include <cmath>

#include "vndf/bsdf/scatter.h"
#include "vndf/validate/checks/distribution_check.h"
#include "vndf/validate/exact/normal_quadrature.h"
#include "vndf/validate/statistics/quasi_random.h"

namespace vndf::validate {
namespace {

constexpr const char* kStage = "furnace";

/// Integral of D(wm) times `factor(wm)` over the nodes.
template <class F>
double integral(const Subject& subject, const Configuration& c, const NormalQuadrature& nodes,
                F factor) {
  std::vector<double> d(nodes.wm.size());
  subject.d(c.alpha, nodes.wm, d);
  double sum = 0;
  for (std::size_t k = 0; k < d.size(); ++k) sum += d[k] * nodes.weight[k] * factor(nodes.wm[k]);
  return sum;
}

double projected_area_error(const Subject& subject, const Configuration& c) {
  const auto nodes = normal_quadrature(*subject.law, NormalLaw::all, c);
  return std::abs(integral(subject, c, nodes, [](const auto& m) { return m.z; }) - nodes.covered);
}

double visible_area_error(const Subject& subject, const Configuration& c) {
  const auto nodes = normal_quadrature(*subject.law, NormalLaw::visible_smith, c);
  const double area =
      integral(subject, c, nodes, [&](const auto& m) { return std::max(0.0, dot(c.wi, m)); });
  return std::abs(area * subject.g1(c) / c.wi.z - nodes.covered);
}

/// G2 both ways between the direction of `c` and all others, of either side, for a few facets that
/// are seen from it.
void see_reciprocity(const Subject& subject, const Configuration& c, Worst& worst) {
  constexpr std::size_t kFacets = 16;
  std::vector<Pair> u(kFacets);
  for (std::size_t k = 0; k < kFacets; ++k) u[k] = even_point(k);
  std::vector<Vec3<double>> wm(kFacets);
  subject.sample(c, u, wm);
  for (const Configuration& other : law_configurations())
    for (const double side : {1.0, -1.0}) {
      const Vec3<double> wo{other.wi.x, other.wi.y, side * other.wi.z};
      for (std::size_t k = 0; k < kFacets; ++k) {
        const double forth = subject.g2(c.alpha, c.wi, wo, wm[k]);
        const double back = subject.g2(c.alpha, wo, c.wi, wm[k]);
        worst.see(std::abs(forth - back), place_of(c, u[k].x, u[k].y));
      }
    }
}

/// Outgoing directions with the solid angle that each stands for.
struct Outgoing {
  std::vector<Vec3<double>> wo;
  std::vector<double> weight;

  void add(const Vec3<double>& w, double solid_angle) {
    if (w.z == 0 || !(solid_angle > 0)) return;
    wo.push_back(w);
    weight.push_back(solid_angle);
  }
};

/// What the facets of `nodes` send up, and down.
Outgoing reflected(const Configuration& c, const NormalQuadrature& nodes) {
  Outgoing out;
  for (std::size_t k = 0; k < nodes.wm.size(); ++k) {
    const double cosine = dot(c.wi, nodes.wm[k]);
    const auto wo = reflect(c.wi, nodes.wm[k]);
    if (cosine > 0 && wo.z > 0) out.add(wo, nodes.weight[k] * reflection_jacobian(cosine));
  }
  return out;
}
Outgoing refracted(const Configuration& c, const NormalQuadrature& nodes) {
  Outgoing out;
  for (std::size_t k = 0; k < nodes.wm.size(); ++k) {
    const double cosine = dot(c.wi, nodes.wm[k]);
    const auto wo = refract(c.wi, nodes.wm[k], kGlassIndex);
    if (cosine > 0 && wo && wo->z < 0)
      out.add(*wo,
              nodes.weight[k] * refraction_jacobian(cosine, dot(*wo, nodes.wm[k]), kGlassIndex));
  }
  return out;
}

template <class Bsdf>
double energy(const Bsdf& bsdf, const Configuration& c, const Outgoing& out) {
  std::vector<double> f(out.wo.size());
  bsdf(c, out.wo, f);
  double sum = 0;
  for (std::size_t k = 0; k < f.size(); ++k) sum += f[k] * out.weight[k];
  return sum;
}

/// What is sent out beyond what comes in.
struct Excess {
  Worst mirror, glass;
};

void see_energy(const Subject& subject, const Configuration& c, Excess& excess) {
  // All normals scatter as those that are seen.
  const bool cavities = subject.claims.law == NormalLaw::visible_v_cavity;
  const auto nodes = normal_quadrature(
      *subject.law, cavities ? NormalLaw::visible_v_cavity : NormalLaw::visible_smith, c);
  const Outgoing up = reflected(c, nodes), down = refracted(c, nodes);
  const double mirror = energy(subject.mirror, c, up);
  const double glass = energy(subject.glass, c, up) + energy(subject.glass, c, down);
  // What is not a number stays so.
  excess.mirror.see(mirror <= 1 ? 0 : mirror - 1, place_of(c));
  excess.glass.see(glass <= 1 ? 0 : glass - 1, place_of(c));
}

/// All that is measured at one configuration.
struct FurnaceErrors {
  Worst projected, visible, reciprocity;
  Excess excess;
};

}  // namespace

std::vector<Finding> test_furnace(const Subject& subject, const support::Workers& workers) {
  const auto& list = law_configurations();
  const bool smith = subject.claims.law != NormalLaw::visible_v_cavity;
  std::vector<FurnaceErrors> each(list.size());
  support::parallel_for(list.size(), workers, [&](std::size_t i) {
    each[i].projected.see(projected_area_error(subject, list[i]), place_of(list[i]));
    if (smith && list[i].wi.z > 0)
      each[i].visible.see(visible_area_error(subject, list[i]), place_of(list[i]));
    see_reciprocity(subject, list[i], each[i].reciprocity);
    see_energy(subject, list[i], each[i].excess);
  });
  FurnaceErrors all;
  for (const FurnaceErrors& e : each) {
    all.projected.see(e.projected);
    all.visible.see(e.visible);
    all.reciprocity.see(e.reciprocity);
    all.excess.mirror.see(e.excess.mirror);
    all.excess.glass.see(e.excess.glass);
  }
  const double bound = subject.bounds.function_error;
  std::vector<Finding> findings{all.projected.finding(kStage, "projected area - 1", bound)};
  if (smith) findings.push_back(all.visible.finding(kStage, "weak white furnace - 1", bound));
  findings.push_back(all.reciprocity.finding(kStage, "reciprocity of G2", kReciprocityError));
  findings.push_back(all.excess.mirror.finding(kStage, "energy of a mirror over 1", bound));
  findings.push_back(all.excess.glass.finding(kStage, "energy of glass over 1", bound));
  return findings;
}

}  // namespace vndf::validate
