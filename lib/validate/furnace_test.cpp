// Stage: conservation of area.
#include "validate/furnace_test.h"

#include <algorithm>
#include <cmath>

#include "validate/law_test.h"
#include "validate/normal_quadrature.h"

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

}  // namespace

std::vector<Finding> test_furnace(const Subject& subject, const precompute::Workers& workers) {
  const auto& list = law_configurations();
  const bool smith = subject.claims.law != NormalLaw::visible_v_cavity;
  std::vector<Worst> projected(list.size()), visible(list.size());
  precompute::parallel_for(list.size(), workers, [&](std::size_t i) {
    projected[i].see(projected_area_error(subject, list[i]), place_of(list[i]));
    if (smith && list[i].wi.z > 0)
      visible[i].see(visible_area_error(subject, list[i]), place_of(list[i]));
  });
  Worst all_projected, all_visible;
  for (std::size_t i = 0; i < list.size(); ++i) {
    all_projected.see(projected[i]);
    all_visible.see(visible[i]);
  }
  const double bound = subject.bounds.function_error;
  std::vector<Finding> findings{all_projected.finding(kStage, "projected area - 1", bound)};
  if (smith) findings.push_back(all_visible.finding(kStage, "weak white furnace - 1", bound));
  return findings;
}

}  // namespace vndf::validate
