// Radial profiles read from text, and every reason to refuse one.
#include "vndf/distributions/profile_csv.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "support/catch.h"

using namespace vndf::distributions;
using namespace vndf::test;

namespace {

RadialProfile read(const std::string& text) {
  std::istringstream stream(text);
  return read_profile_csv(stream, "profile.csv");
}

}  // namespace

TEST_CASE("a profile over the slope radius is read as it stands") {
  const RadialProfile profile = read("r,p22\n0,1\n0.5,+8e-1\n1,0.25\n2,0\n");
  CHECK(profile.r == std::vector<double>{0, 0.5, 1, 2});
  CHECK(profile.p22 == std::vector<double>{1, 0.8, 0.25, 0});
}

TEST_CASE("comments, blank lines, blanks, line ends of other systems and a byte order mark pass") {
  const RadialProfile profile =
      read("\xEF\xBB\xBF# a comment\r\n\r\n r , p22 \r\n0, 4\r\n# another\n\n1,3\t\r\n2 ,2\r\n3,1");
  CHECK(profile.r == std::vector<double>{0, 1, 2, 3});
  CHECK(profile.p22 == std::vector<double>{4, 3, 2, 1});
}

TEST_CASE("D over theta becomes p22 = D cos^4(theta) over r = tan(theta)") {
  const RadialProfile radians = read("theta,D\n0,2\n0.3,1.5\n0.7,1\n1.5,0.5\n");
  const RadialProfile degrees = read("theta_deg,D\n0,2\n30,1.5\n60,1\n89,0.5\n");
  const std::vector<double> density{2, 1.5, 1, 0.5};
  const std::vector<double> in_radians{0, 0.3, 0.7, 1.5}, in_degrees{0, 30, 60, 89};
  for (std::size_t i = 0; i < density.size(); ++i) {
    const double theta = in_degrees[i] * std::numbers::pi / 180;
    CHECK(radians.r[i] == Approx(std::tan(in_radians[i])));
    CHECK(radians.p22[i] == Approx(density[i] * std::pow(std::cos(in_radians[i]), 4)));
    CHECK(degrees.r[i] == Approx(std::tan(theta)));
    CHECK(degrees.p22[i] == Approx(density[i] * std::pow(std::cos(theta), 4)));
  }
}

TEST_CASE("columns are found by their names, and others are ignored") {
  const RadialProfile profile = read("band,p22,note,r\n1,4,x,0\n1,3,,1\n1,2,nan,2\n1,1,#,3\n");
  CHECK(profile.r == std::vector<double>{0, 1, 2, 3});
  CHECK(profile.p22 == std::vector<double>{4, 3, 2, 1});
  // The radius counts where a table has the angle besides.
  const RadialProfile both = read("theta_deg,D,r,p22\n0,9,0,4\n9,9,1,3\n18,9,2,2\n27,9,3,1\n");
  CHECK(both.r == profile.r);
  CHECK(both.p22 == profile.p22);
}

TEST_CASE("a line of the greatest length is read, with a line end or without") {
  const std::string head = "r,p22\n0,1\n1,1\n2,1\n", number = "3,1";
  const std::string longest = number + std::string(8192 - number.size(), ' ');
  CHECK(read(head + longest).r.size() == 4);
  CHECK(read(head + longest + "\n4,1\n").r.size() == 5);
  CHECK_THROWS_WITH(read(head + longest + " \n"), contains("longer than 8192 bytes"));
}

TEST_CASE("a bad profile is refused with its name, the line and the rule") {
  const std::string start = "r,p22\n0,1\n1,1\n";
  const std::vector<std::pair<std::string, std::string>> bad{
      {"",
       "profile.csv: it is empty; the first line must name the columns of one of 'r,p22' "
       "'theta,D'"},
      {"\n# nothing\n", "it is empty"},
      {"radius,p22\n0,1\n", "line 1: the header 'radius,p22' is not known"},
      {"\n0,1\n1,1\n", "line 2: the header '0,1' is not known"},
      {start + "2,1\n", "profile.csv: it has 3 samples; at least 4 are needed"},
      {start + "x,1\n", "line 4: 'x' is not a finite number"},
      {start + "2,1e\n", "line 4: '1e' is not a finite number"},
      {start + "2,nan\n", "line 4: 'nan' is not a finite number"},
      {start + "inf,1\n", "line 4: 'inf' is not a finite number"},
      {start + "2,1e999\n", "line 4: '1e999' is not a finite number"},
      {start + "2,\n", "line 4: '' is not a finite number"},
      {start + "2\n", "line 4: the line has 1 fields and the header 2"},
      {start + "2,1,1\n", "line 4: the line has 3 fields and the header 2"},
      {start + "\n1,1\n", "line 5: r is the same as in the sample before"},
      {start + "0.5,1\n", "line 4: r must increase"},
      {start + "2,-1\n", "line 4: p22 must not be negative"},
      {"r,p22\n-1,1\n", "line 2: r must not be negative"},
      {"theta,D\n0,1\n30,1\n",
       "line 3: theta must lie in [0, pi/2), in radians; name the column theta_deg if"},
      {"r,sigma\n0,1\n", "line 1: the header 'r,sigma' is not known"},
      {"r,p22,sigma\n0,1\n", "line 2: the line has 2 fields and the header 3"},
      {std::string("r,p22\n0,1\0\n", 11), "line 2: there is a zero byte"},
      {start + "2," + std::string(9000, '1'), "line 4: the line is longer than 8192 bytes"},
      {std::string(100000, 'x'), "line 1: the line is longer than 8192 bytes"},
      {"theta,D\n-0.1,1\n", "line 2: theta must lie in [0, pi/2)"},
      {"theta_deg,D\n0,1\n90,1\n", "line 3: theta_deg must lie in [0, 90)"},
      {"theta,D\n0,-1\n", "line 2: D must not be negative"}};
  for (const auto& [text, message] : bad) {
    CAPTURE(text);
    CHECK_THROWS_WITH(read(text), contains("profile.csv") && contains(message));
    CHECK_THROWS_AS(read(text), std::runtime_error);
  }
}

TEST_CASE("profiles are read from files; a missing one is named") {
  const auto path = std::filesystem::temp_directory_path() / "vndf-profile-test.csv";
  std::ofstream(path) << "r,p22\n0,4\n1,3\n2,2\n3,1\n";
  CHECK(read_profile_csv(path).r.size() == 4);
  std::filesystem::remove(path);
  CHECK_THROWS_WITH(read_profile_csv(path),
                    contains("vndf-profile-test.csv") && contains("no such file"));
}
