// What a script meets in vndf validate and vndf check: output, files, exit status.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>
#include <string>

#include "support/catch.h"
#include "support/program_folder.h"

using namespace vndf::test;

namespace {

/// Lines for vndf sample --stdin: random directions and roughness.
std::string inputs(std::size_t count) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> uniform;
  std::ostringstream text;
  text.precision(9);
  for (std::size_t k = 0; k < count; ++k) {
    const float theta = 1.57f * uniform(random), phi = 6.28f * uniform(random);
    text << std::sin(theta) * std::cos(phi) << ' ' << std::sin(theta) * std::sin(phi) << ' '
         << std::cos(theta) << ' ' << 0.1f + uniform(random) << ' ' << 0.1f + uniform(random) << ' '
         << uniform(random) << ' ' << uniform(random) << '\n';
  }
  return text.str();
}

/// Records of the tables in `folder`, as a renderer's author would write them.
void write_records(const FolderWithTables& folder, const std::string& name, std::size_t count) {
  const std::string lines = inputs(count);
  std::istringstream in(lines), out(folder.run("sample ggx.h5 --stdin", lines).out);
  std::ofstream records(folder / name);
  records << "wx,wy,wz,ax,ay,u1,u2,mx,my,mz,pdf\n";
  std::string line, slope_x, slope_y, field;
  while (std::getline(in, line)) {
    for (char& c : line) c = c == ' ' ? ',' : c;
    out >> slope_x >> slope_y;
    records << line;
    for (int k = 0; k < 4 && out >> field; ++k) records << ',' << field;
    records << '\n';
  }
}

}  // namespace

TEST_CASE("validate prints a table with its seed and returns 0 for tables that are right") {
  const FolderWithTables folder;
  const Result r = folder.run("validate ggx.h5 --quick --seed 7 --json verdict.json");
  CHECK(r.status == 0);
  CHECK(r.error.empty());
  CHECK_THAT(r.out, contains("seed 7") && contains("ggx.h5: pass") &&
                        contains("u-error of slope x") && contains("sphere chi-square"));
  const auto json = nlohmann::json::parse(content(folder / "verdict.json"));
  CHECK(json.at("seed") == 7);
  CHECK(json.at("passed") == true);
  CHECK(json.at("samplers").at(0).at("results").size() > 20);
}

TEST_CASE("validate prints a fresh seed where none is given") {
  const FolderWithTables folder;
  const auto first = folder.run("validate ggx.h5 --quick").out;
  const auto second = folder.run("validate ggx.h5 --quick").out;
  CHECK(first.substr(0, first.find('\n')) != second.substr(0, second.find('\n')));
}

TEST_CASE("validate makes the distribution of a formula again from the file") {
  const Folder folder;
  REQUIRE(
      folder.run("build --p22 'exp(-a*r^2)*(1+r)' --param a=2 -o f.h5 --size 64 --quiet").status ==
      0);
  CHECK(folder.run("validate f.h5 --quick").status == 0);
}

TEST_CASE("validate checks tables of every layout that build makes") {
  const Folder folder;
  for (const std::string layout : {"--size 48x64", "--size 48 --precision double"}) {
    CAPTURE(layout);
    REQUIRE(folder.run("build ggx -o t.h5 --quiet " + layout).status == 0);
    const Result r = folder.run("validate t.h5 --quick --seed 1");
    CHECK(r.error.empty());
    CHECK(r.status == 0);
  }
}

TEST_CASE("validate makes all checks on the surface of its options, and names it") {
  const FolderWithTables folder;
  const Result r = folder.run(
      "validate ggx.h5 --quick --seed 1 --correlation -0.5 --mean 0.7,-0.4 --json verdict.json");
  CHECK(r.status == 0);
  CHECK_THAT(r.out, contains(", correlation -0.5, mean slope 0.7 x -0.4") &&
                        contains("single precision does not carry their slopes: alpha 0.001"));
  const auto json = nlohmann::json::parse(content(folder / "verdict.json"));
  const auto& results = json.at("samplers").at(0).at("results");
  CHECK(results.at(1).at("correlation") == -0.5);
  CHECK(results.at(1).at("mean_y").get<double>() == Approx(-0.4));
  CHECK(folder.run("validate ggx.h5 --quick --seed 1 --rotate 30").status == 0);
  CHECK(folder.run("validate ggx.h5 --quick --correlation 1").status == 2);
  CHECK(folder.run("validate ggx.h5 --quick --correlation 0.5 --rotate 30").status == 2);
  const Result unmapped = folder.run("validate ggx.h5 --quick --as-mapped");
  CHECK(unmapped.status == 1);
  CHECK_THAT(unmapped.error, contains("ggx.h5: it records no surface"));
  const Result narrow = folder.run("validate ggx.h5 --quick --correlation 0.99999");
  CHECK(narrow.status == 1);
  CHECK_THAT(narrow.error, contains("ggx.h5") && contains("give a correlation nearer to 0"));
}

TEST_CASE("validate refuses what it does not know") {
  const Folder folder;
  const Result unknown = folder.run("validate nothing");
  CHECK(unknown.status == 1);
  CHECK_THAT(unknown.error, contains("'nothing' is neither a table file nor a reference sampler"));
  CHECK(folder.run("validate").status == 2);
  CHECK(folder.run("validate x.h5 --quick --thorough").status == 2);
}

/// A folder with tables and with 20000 samples of them, "records.csv".
class FolderWithRecords : public FolderWithTables {
 public:
  FolderWithRecords() { write_records(*this, "records.csv", 20000); }
};

TEST_CASE("check accepts the records of tables, and says what their number can see") {
  const FolderWithRecords folder;
  const Result r = folder.run("check records.csv --against ggx --u-error 1e-3 --json verdict.json");
  CHECK(r.status == 0);
  CHECK_THAT(r.out, contains("accepted") && contains("20000 samples") && contains("in u"));
  CHECK(nlohmann::json::parse(content(folder / "verdict.json")).at("passed") == true);
  CHECK(folder.run("check records.csv --against ggx.h5 --inverse no").status == 0);
}

TEST_CASE("check takes columns of a surface, and names it where records are not of it") {
  const FolderWithRecords folder;
  std::ifstream records(folder / "records.csv");
  std::ofstream tilted(folder / "tilted.csv");
  std::string line, rest;
  std::getline(records, line);
  tilted << "wx,wy,wz,ax,ay,correlation,mean_x,mean_y,u1,u2,mx,my,mz,pdf\n";
  while (std::getline(records, line)) {
    std::size_t after_ay = 0;
    for (int k = 0; k < 5; ++k) after_ay = line.find(',', after_ay) + 1;
    tilted << line.substr(0, after_ay) << "0.5,0,0," << line.substr(after_ay) << '\n';
  }
  tilted.close();
  const Result r = folder.run("check tilted.csv --against ggx --json verdict.json");
  CHECK(r.status == 1);
  CHECK_THAT(r.out, contains("rejected: ") && contains(", correlation 0.5"));
}

TEST_CASE("check rejects with status 1, the statistic, theta and alpha") {
  const FolderWithRecords folder;
  const Result r = folder.run("check records.csv --against beckmann");
  CHECK(r.status == 1);
  CHECK_THAT(r.out, contains("rejected: ") && contains("at theta") && contains("alpha"));
}

TEST_CASE("check returns 2 for input that it cannot use, with file, line and rule") {
  const Folder folder;
  std::ofstream(folder / "bad.csv") << "wx,wy,wz,ax,ay,mx,my,mz\n0,0,1,1,1,0,0,2\n";
  const Result r = folder.run("check bad.csv --against ggx");
  CHECK(r.status == 2);
  CHECK_THAT(r.error, contains("bad.csv, line 2: mx,my,mz must have length 1"));
  CHECK(folder.run("check none.csv --against ggx").status == 2);
  CHECK(folder.run("check bad.csv --against nothing").status == 2);
  CHECK(folder.run("check bad.csv").status == 2);
}

TEST_CASE("check names a file of no use and what it lacks, whatever its bytes are") {
  const Folder folder;
  const auto refused = [&](const std::string& bytes, const std::string& why) {
    std::ofstream(folder / "r.csv", std::ios::binary) << bytes;
    const Result r = folder.run("check r.csv --against ggx --json v.json");
    CAPTURE(why);
    CHECK(r.status == 2);
    CHECK(r.out.empty());
    CHECK_THAT(r.error, contains("r.csv") && contains(why));
    CHECK(std::count(r.error.begin(), r.error.end(), '\n') == 1);
    CHECK(folder.files() == std::vector<std::string>{"r.csv"});
  };
  const std::string header = "wx,wy,wz,ax,ay,mx,my,mz";
  refused("", "it is empty");
  refused(header + "\n", "there are 0 records; give 100 or more");
  refused("\xEF\xBB\xBF" + header + "\r\n0,0,1,1,1,0,0,1\r\n", "there are 1 records");
  refused(header + "\n0,0,1,1,1,nan,0,1\n", "line 2: 'nan' is not a finite number");
  refused(std::string("\xFF\xFEw\0x\0", 6), "line 1: there is a zero byte");
  refused(header + "\r0,0,1,1,1,0,0,1\r", "line 1: the header 'wx,wy,wz,ax,ay,mx,my,mz?0,0");
}

TEST_CASE("check does not write its verdict over what it reads, nor where it cannot") {
  const FolderWithTables folder;
  write_records(folder, "records.csv", 200);
  const std::string records = content(folder / "records.csv"), tables = content(folder / "ggx.h5");
  for (const std::string name : {"records.csv", "ggx.h5", "none/verdict.json", "."}) {
    CAPTURE(name);
    const Result r = folder.run("check ./records.csv --against ./ggx.h5 --json " + name);
    CHECK(r.status == 2);
    CHECK(r.out.empty());
    CHECK_THAT(r.error, contains(name + ": "));
  }
  CHECK(folder.run("check records.csv --against ggx --u-error nan").status == 2);
  CHECK(folder.run_on_full_disk("check records.csv --against ggx").status == 2);
  CHECK(content(folder / "records.csv") == records);
  CHECK(content(folder / "ggx.h5") == tables);
}
