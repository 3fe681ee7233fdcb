// The list of named distributions.
#include "vndf/distributions/family_list.h"

#include <utility>

#include "vndf/distributions/families.h"
#include "vndf/support/text.h"

namespace vndf::distributions {
namespace {

template <class Family>
FamilyInfo without_parameter(std::string name, std::string density, std::string source) {
  return {
      std::move(name),   "", std::move(density),
      std::move(source), {}, [](const std::vector<double>&) { return std::make_unique<Family>(); }};
}

template <class Family>
FamilyInfo with_parameter(std::string name, FamilyParameter parameter, std::string density,
                          std::string source) {
  const std::string shown = parameter.name + "=" + support::number_text(parameter.default_value) +
                            " (" + parameter.range() + ")";
  return {std::move(name),
          shown,
          std::move(density),
          std::move(source),
          {std::move(parameter)},
          [](const std::vector<double>& v) { return std::make_unique<Family>(v.front()); }};
}

FamilyInfo mixture() {
  return {"mixture",
          "WEIGHT*FAMILY[:PARAMETERS][@ROUGHNESS] + ... (0.001 to 1000)",
          "sum w_i p22_i(r/a_i)/a_i^2, the weights divided by their sum",
          "two-lobe blends of renderers, for example the haze of OpenPBR",
          {},
          {}};
}

}  // namespace

std::string FamilyParameter::range() const {
  return support::number_text(least) + " to " + support::number_text(greatest);
}

// The ranges were found by building tables at and around their ends. Heavy tails below 1.55 have
// slopes beyond the largest float, and gamma-distributed roughness of nu < 0.3 has a pole that the
// nodes do not follow. Above p = 50 and inner = 0.999 there is an edge that rows do not follow. The
// limits at 1e6 and 1e8 are where a family is Beckmann's to rounding and its own scale would
// underflow soon.
const std::vector<FamilyInfo>& families() {
  static const std::vector<FamilyInfo> list = {
      without_parameter<Beckmann>("beckmann", "exp(-r^2)/pi", "Beckmann and Spizzichino 1963"),
      without_parameter<Ggx>("ggx", "1/(pi (1+r^2)^2)",
                             "Trowbridge and Reitz 1975; Walter et al. 2007"),
      with_parameter<StudentT>("student-t", {"gamma", 2.5, 1.55, 1e6},
                               "(1+r^2/(gamma-1))^-gamma/pi; gamma = 2 is ggx",
                               "Ribardiere et al. 2017"),
      with_parameter<HyperCauchy>(
          "hyper-cauchy", {"q", 1.75, 1.55, 1e6},
          "(q-1) 2^(q-1)/(pi (2+r^2)^q); student-t, slopes times sqrt(2/(q-1))",
          "Wellems et al. 2006"),
      with_parameter<ExponentialPower>("exponential-power", {"p", 1, 0.2, 50},
                                       "p/(2 pi Gamma(2/p)) exp(-r^p); p = 2 is beckmann",
                                       "generalised Beckmann of exponent p/2, Hoffman 2016"),
      with_parameter<KDistribution>(
          "k", {"nu", 1, 0.3, 100},
          "2 nu/(pi Gamma(nu)) (z/2)^(nu-1) K_{nu-1}(z), z = 2 sqrt(nu) r",
          "Beckmann whose squared roughness is gamma-distributed"),
      without_parameter<UniformDisk>("disk", "1/pi for r < 1", "pearson-ii of m = 0"),
      with_parameter<PearsonII>("pearson-ii", {"m", 1, -0.5, 1e8}, "(m+1)/pi (1-r^2)^m for r < 1",
                                "Pearson's type II, in two dimensions"),
      with_parameter<Annulus>("annulus", {"inner", 0.5, 0, 0.999},
                              "1/(pi (1-inner^2)) for inner <= r < 1",
                              "difference of two uniform disks"),
      without_parameter<Volcano>("volcano", "r^2 exp(-r^2)/pi", "no normal upright, as in sheen"),
      with_parameter<BlinnPhong>(
          "blinn-phong", {"n", 50, -0.9, 1e6},
          "(n+2)/(2 pi) (1+r^2)^-(n+4)/2, at its own scale r = tan(theta)",
          "Blinn 1977, one exponent as the shape: student-t of gamma = (n+4)/2"),
      mixture()};
  return list;
}

}  // namespace vndf::distributions
