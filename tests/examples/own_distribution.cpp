#include <cmath>
#include <iostream>

#include "io/table_file.h"
#include "precompute/build_tables.h"

class StudentT final : public vndf::precompute::SlopeDistribution {
 public:
  std::string name() const override { return "student-t 3"; }
  double p22(double r) const override { return std::pow(1 + r * r / 2, -3); }  // any scale
};

int main(int, char** argv) {
  const auto built = vndf::precompute::build_tables(StudentT(), {.layout = {.rows = 256, .columns = 256}});
  vndf::io::save(argv[1],
                 {built.tables, {"own_distribution", "own_distribution"}, built.certificate});
  std::cout << "max u-error " << built.certificate.marginal.max_u_error << '\n';
}
