#include <cmath>
#include <iostream>

#include "vndf/precompute/bake_certified.h"
#include "vndf/precompute/build_tables.h"

class StudentT final : public vndf::distributions::SlopeDistribution {
 public:
  std::string name() const override { return "student-t 3"; }
  double p22(double r) const override { return std::pow(1 + r * r / 2, -3); }  // any scale
};

int main(int, char** argv) {
  const StudentT student_t;
  const auto pair = vndf::precompute::build_tables(student_t).tables;
  const auto baked = vndf::precompute::bake_certified(student_t, *pair, {.tolerance = 1e-5});
  vndf::save(argv[1], baked);
  std::cout << "max u-error " << baked.certificate().marginal.max_u_error << '\n';
}
