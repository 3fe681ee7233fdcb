// Specifications: what they mean, that names read back, and every error with its column.
#include "vndf/distributions/parse_distribution.h"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "support/catch.h"
#include "vndf/distributions/families.h"
#include "vndf/distributions/family_list.h"
#include "vndf/support/text.h"

using namespace vndf::distributions;
using namespace vndf::test;

namespace {

std::string name_of(const std::string& spec) {
  return parse_distribution(spec)->name();
}

void check_refused(const std::string& spec, const std::string& why, int column) {
  CAPTURE(spec);
  CHECK_THROWS_AS(parse_distribution(spec), std::invalid_argument);
  CHECK_THROWS_WITH(parse_distribution(spec),
                    contains(why) &&
                        contains("(column " + std::to_string(column) + " of '" + spec + "')") &&
                        !contains("\n"));
}

}  // namespace

TEST_CASE("names without a parameter take the documented default") {
  CHECK(name_of("ggx") == "ggx");
  CHECK(name_of("beckmann") == "beckmann");
  CHECK(name_of("disk") == "disk");
  CHECK(name_of("volcano") == "volcano");
  CHECK(name_of("student-t") == "student-t:gamma=2.5");
  CHECK(name_of("hyper-cauchy") == "hyper-cauchy:q=1.75");
  CHECK(name_of("exponential-power") == "exponential-power:p=1");
  CHECK(name_of("k") == "k:nu=1");
  CHECK(name_of("pearson-ii") == "pearson-ii:m=1");
  CHECK(name_of("annulus") == "annulus:inner=0.5");
  CHECK(name_of("blinn-phong") == "blinn-phong:n=50");
}

TEST_CASE("parameters are read") {
  CHECK(parse_distribution("student-t:gamma=4")->p22(0.5) == StudentT(4).p22(0.5));
  CHECK(parse_distribution("annulus:inner=0.25")->p22(0.3) == Annulus(0.25).p22(0.3));
  CHECK(name_of("exponential-power:p=5e-1") == "exponential-power:p=0.5");
  CHECK(name_of("pearson-ii:m=-0.25") == "pearson-ii:m=-0.25");
  CHECK(name_of(" student-t : gamma = 4 ") == "student-t:gamma=4");
}

TEST_CASE("mixtures are read, exponents of numbers included") {
  CHECK(name_of("mixture:0.7*ggx+0.3*beckmann@0.2") == "mixture:0.7*ggx+0.3*beckmann@0.2");
  CHECK(name_of("mixture: 7e-1*ggx@1e+0 + 3E-1*beckmann@2e-1") ==
        "mixture:0.7*ggx+0.3*beckmann@0.2");
  CHECK(name_of("mixture:0.5*student-t:gamma=3e+0@1+0.5*ggx@0.01") ==
        "mixture:0.5*student-t:gamma=3+0.5*ggx@0.01");
  const auto mixture = parse_distribution("mixture:3*ggx+1*beckmann@0.5");
  const double expected = 0.75 * Ggx().p22(0.4) + 0.25 * Beckmann().p22(0.8) * 4;
  CHECK(mixture->p22(0.4) == Approx(expected).epsilon(1e-15));
}

TEST_CASE("a name is a specification of an equal distribution") {
  for (const char* spec :
       {"ggx", "student-t:gamma=1.5500000000000003", "k:nu=0.3", "blinn-phong:n=1e-7",
        "mixture:0.1*ggx+0.2*k:nu=3@0.3333333333333333+1e-20*annulus:inner=0.1"}) {
    const auto d = parse_distribution(spec), again = parse_distribution(d->name());
    CHECK(again->name() == d->name());
    for (const double r : {0.0, 0.2, 3.0}) CHECK(again->p22(r) == d->p22(r));
  }
}

TEST_CASE("unknown families are refused with the nearest known one") {
  check_refused("gxx", "no distribution is called 'gxx'; did you mean 'ggx'? known: beckmann, ggx",
                1);
  check_refused("beckman", "did you mean 'beckmann'?", 1);
  check_refused("phong", "did you mean 'blinn-phong'?", 1);
  check_refused("student:gamma=3", "did you mean 'student-t'?", 1);
  check_refused("mixture:1*ggx+1*gxx", "did you mean 'ggx'?", 17);
  check_refused("something-else", "'something-else'; known: beckmann, ggx", 1);
  check_refused("", "a distribution is missing; known: beckmann", 1);
}

TEST_CASE("unknown parameters are refused with the nearest known one") {
  check_refused("student-t:gama=2", "student-t has no parameter 'gama'; did you mean 'gamma'?", 11);
  check_refused("student-t:width=2", "has no parameter 'width'; known: gamma", 11);
  check_refused("student-t:=2", "student-t: a parameter has no name; known: gamma", 11);
  check_refused("ggx:gamma=2", "ggx takes no parameters", 5);
}

TEST_CASE("parameters that are no numbers are refused") {
  check_refused("student-t:gamma", "student-t: '=' and a number are missing after 'gamma'", 11);
  check_refused("student-t:gamma=", "student-t: gamma has no number", 17);
  check_refused("student-t:gamma=2x", "gamma is '2x', which is not a finite number", 17);
  check_refused("student-t:gamma=inf", "'inf', which is not a finite number", 17);
  check_refused("student-t:gamma=1e999", "'1e999', which is not a finite number", 17);
  check_refused("student-t:", "student-t: a parameter is missing after ':' or ','", 11);
  check_refused("student-t:gamma=2,", "a parameter is missing after ':' or ','", 19);
  check_refused("student-t:gamma=2,gamma=3", "student-t: 'gamma' is given twice", 19);
}

TEST_CASE("numbers out of range are refused where they stand") {
  check_refused("student-t:gamma=1.5", "student-t: gamma is 1.5; it must be from 1.55 to 1e+06",
                11);
  check_refused("mixture:1*ggx+1*annulus:inner=1@2",
                "annulus: inner is 1; it must be from 0 to 0.999", 25);
}

TEST_CASE(
    "the ends of every range are accepted, and what lies beyond is refused by name and range") {
  for (const FamilyInfo& family : families())
    for (const FamilyParameter& parameter : family.accepts) {
      const auto with = [&](double value) {
        return family.name + ":" + parameter.name + "=" + vndf::support::number_text(value);
      };
      const double infinity = std::numeric_limits<double>::infinity();
      for (const double end : {parameter.least, parameter.greatest})
        CHECK(name_of(with(end)) == with(end));
      for (const double beyond : {std::nextafter(parameter.least, -infinity),
                                  std::nextafter(parameter.greatest, infinity)})
        CHECK_THROWS_WITH(parse_distribution(with(beyond)),
                          contains(family.name + ": " + parameter.name + " is ") &&
                              contains("it must be from " + parameter.range()));
    }
}

TEST_CASE("long texts and mixtures are refused, with a message that quotes a part of them") {
  const auto refused = [](const std::string& spec, const std::string& why) {
    CHECK_THROWS_WITH(parse_distribution(spec), contains(why));
    try {
      parse_distribution(spec);
    } catch (const std::invalid_argument& error) {
      CHECK(std::string(error.what()).size() < 400);
    }
  };
  std::string mixture = "mixture:1*ggx";
  for (int k = 1; k < 16; ++k) mixture += "+1*ggx";
  CHECK(name_of(mixture) == mixture);
  refused(mixture + "+1*ggx", "it has 17 components; at most 16 are allowed");
  refused(std::string(2001, 'g'), "has 2001 characters; at most 2000");
  refused(std::string(2000, 'g'), "no distribution is called 'ggg");
  refused("student-t:" + std::string(1900, 'g') + "=2", "student-t has no parameter 'ggg");
  refused("student-t:gamma=" + std::string(1900, '1') + "x", "gamma is '111");
}

TEST_CASE("broken mixtures are refused") {
  check_refused("mixture", "a mixture needs components: mixture:0.7*ggx+0.3*beckmann@0.2", 1);
  check_refused("mixture:", "mixture: a component is empty", 9);
  check_refused("mixture:1*ggx++1*ggx", "mixture: a component is empty", 15);
  check_refused("mixture:1*ggx+", "mixture: a component is empty", 15);
  check_refused("mixture:1*", "a distribution is missing", 11);
  check_refused("mixture:ggx", "component 'ggx' has no weight; write WEIGHT*FAMILY", 9);
  check_refused("mixture:*ggx", "mixture: the weight has no number", 9);
  check_refused("mixture:a*ggx", "mixture: the weight is 'a', which is not a finite number", 9);
  check_refused("mixture:1*ggx+0*ggx", "mixture: the weight is 0; it must be > 0", 15);
  check_refused("mixture:-1*ggx", "mixture: the weight is -1; it must be > 0", 9);
  check_refused("mixture:1*ggx@0", "mixture: the roughness is 0; it must be from 0.001 to 1000",
                15);
  check_refused("mixture:1*ggx@", "mixture: the roughness has no number", 15);
  check_refused("mixture:1*mixture:1*ggx", "a mixture cannot hold a mixture", 11);
}
