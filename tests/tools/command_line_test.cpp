// The program as a person or a script meets it: output, exit status, messages.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "support/catch.h"
#include "support/program_folder.h"
#include "vndf/io/exr_image.h"

namespace fs = std::filesystem;
using vndf::test::Approx;
using vndf::test::contains;
using vndf::test::content;
using vndf::test::Folder;
using vndf::test::FolderWithTables;
using vndf::test::Result;

namespace {

void check_failure(const Result& r, int status, const std::string& message) {
  CHECK(r.status == status);
  CHECK_THAT(r.error, contains(message));
  CHECK(r.out.empty());
}

void check_one_line_failure(const Result& r, const std::string& message) {
  check_failure(r, 1, message);
  CHECK(std::count(r.error.begin(), r.error.end(), '\n') == 1);
}

std::vector<double> numbers(const std::string& line, char separator = ' ') {
  std::vector<double> list;
  std::istringstream fields(line);
  for (std::string field; std::getline(fields, field, separator);) list.push_back(std::stod(field));
  return list;
}

}  // namespace

TEST_CASE("help of the program and of every subcommand explains itself") {
  const Folder folder;
  const Result help = folder.run("--help");
  CHECK(help.status == 0);
  for (const std::string name : {"build", "bake", "export", "info", "sample", "convert", "picture",
                                 "bench", "experiment", "validate", "check"}) {
    CHECK_THAT(help.out, contains(name));
    CHECK(folder.run(name + " --help").status == 0);
  }
}

TEST_CASE("help tells the value of an option, its default, and what it cannot be beside") {
  const Folder folder;
  const std::string help = folder.run("build --help").out;
  CHECK_THAT(help, contains("Usage: vndf build [OPTIONS] [distribution]"));
  CHECK_THAT(help, contains("  -o, --output FILE           File to write"));
  CHECK_THAT(help, contains("  --precision {single,double} \n"));  // one blank would end it
  CHECK_THAT(help, contains("  --threads NUMBER            ") && contains("(default 0)"));
  CHECK_THAT(help, contains("as one JSON object; not with --quiet\n"));
  CHECK_THAT(help, !contains("not with --list"));
  CHECK_THAT(folder.run("experiment variance --help").out, contains("(default 30,180)"));
  CHECK_THAT(folder.run("export --help").out, contains("  --as {header,cuda,"));
  CHECK_THAT(folder.run("info --help").out, contains("Usage: vndf info [OPTIONS] file\n"));
  CHECK_THAT(folder.run("--help").out, contains("  info                        Show what") &&
                                           !contains("errors that were measured"));
}

TEST_CASE("build writes the file and reports its certificate") {
  const Folder folder;
  const Result r = folder.run("build ggx -o ggx.h5 --size 32");
  CHECK(r.status == 0);
  CHECK_THAT(r.out, contains("32 x 32") && contains("u-error, max") && contains("tail mass ratio"));
  CHECK(r.error.empty());  // no progress bar where there is no terminal
  CHECK(folder.files() == std::vector<std::string>{"ggx.h5"});
}

TEST_CASE("build --json prints one object with sizes, seconds, bytes and the certificate") {
  const Folder folder;
  const auto report =
      nlohmann::json::parse(folder.run("build beckmann -o b.exr --size 24x40 --json").out);
  CHECK(report.at("marginal_size") == nlohmann::json{47, 40});
  CHECK(report.at("conditional_size") == nlohmann::json{24, 40});
  CHECK(report.at("bytes") == fs::file_size(folder / "b.exr"));
  CHECK(report.at("seconds") > 0);
  CHECK(report.at("mass").get<double>() == Approx(1));
  CHECK(report.at("certificate").at("marginal_max_u_error") > 0);
  CHECK(report.at("certificate").at("conditional_upper_tail_ratio_1e-6") > 0);
}

TEST_CASE("build --quiet prints nothing") {
  const Folder folder;
  const Result r = folder.run("build ggx -o ggx.h5 --size 64 --quiet");
  CHECK(r.status == 0);
  CHECK(r.out.empty());
  CHECK(r.error.empty());
}

TEST_CASE("the file does not depend on the number of threads") {
  const Folder folder;
  folder.run("build ggx -o ggx.h5 --size 32 --threads 1 --quiet");
  const std::string one = content(folder / "ggx.h5");
  folder.run("build ggx -o ggx.h5 --size 32 --threads 3 --quiet");
  CHECK(content(folder / "ggx.h5") == one);
}

TEST_CASE("failures of build are one line, exit status 1, and leave nothing behind") {
  const Folder folder;
  check_one_line_failure(folder.run("build gxx -o a.h5"), "'gxx'");
  check_one_line_failure(folder.run("build ggx -o a.txt"), "a.txt");
  check_one_line_failure(folder.run("build ggx -o no/such/folder/a.h5 --size 16"),
                         "no/such/folder");
  check_one_line_failure(folder.run("build ggx -o a.h5 --size 1x16"), "table size 1x16");
  CHECK(folder.files().empty());
}

TEST_CASE("wrong usage is exit status 2") {
  const Folder folder;
  check_failure(folder.run(""), 2, "subcommand");
  check_failure(folder.run("build -o a.h5"), 2, "--p22");
  check_failure(folder.run("build ggx"), 2, "--output");
  check_failure(folder.run("build ggx -o a.h5 --size 12y"), 2, "'12y'");
  check_failure(folder.run("build ggx -o a.h5 --nonsense"), 2, "nonsense");
  check_failure(folder.run("sample a.h5"), 2, "--wi");
  check_failure(folder.run("sample a.h5 --stdin --wi 0,0,1"), 2, "--stdin");
  check_failure(folder.run("sample a.h5 --wi 0,0 --alpha 1"), 2, "--wi");
  check_failure(folder.run("sample a.h5 --wi 0,0,1 --alpha 0"), 2, "alpha");
}

TEST_CASE(
    "a number that is out of its range or no number at all is wrong usage, never another one") {
  const FolderWithTables folder;
  const std::string sample = "sample ggx.h5 --wi 0,0,1 --alpha 1 ";
  check_failure(folder.run(sample + "-n -3"), 2, "'-3' is not a whole number");
  check_failure(folder.run(sample + "-n 010"), 2, "'010'");  // no octal digits
  check_failure(folder.run(sample + "--seed -1"), 2, "--seed");
  check_failure(folder.run(sample + "--seed 99999999999999999999"), 2, "18446744073709551615");
  check_failure(folder.run("sample ggx.h5 --wi nan,0,1 --alpha 1"), 2, "finite");
  check_failure(folder.run("sample ggx.h5 --wi 0,0,1 --alpha 1e39"), 2, "--double");
  check_failure(folder.run("sample ggx.h5 --wi 0,0,1 --alpha 1,1e-60"), 2, "--double");
  check_failure(folder.run("build ggx -o a.h5 --size 16 --threads 1000000"), 2, "4096");
  check_failure(folder.run("bench --quick --repetitions 2.5"), 2, "'2.5'");
  check_failure(folder.run("experiment variance --distribution ggx --seed x"), 2, "'x'");
  CHECK(folder.run("sample ggx.h5 --wi 0,0,1 --alpha 1e39 --double -n 1").status == 0);
  CHECK(folder.files() == std::vector<std::string>{"ggx.h5"});
}

TEST_CASE("a place that cannot be written is refused before any work, and what is there stays") {
  const FolderWithTables folder;
  fs::create_directories(folder / "folder.h5");
  fs::create_directories(folder / "folder.png");
  const std::string tables = content(folder / "ggx.h5");
  // Thousands of seconds of work, were it begun.
  const std::string build = "build 'mixture:0.5*ggx+0.5*beckmann@0.01' --size 8192 -o ";
  check_one_line_failure(folder.run(build + "none/a.h5"), "none/a.h5: the folder 'none'");
  check_one_line_failure(folder.run(build + "folder.h5"), "folder.h5: it exists and is not a file");
  check_one_line_failure(folder.run("convert ggx.h5 folder.h5"), "folder.h5");
  check_one_line_failure(folder.run("picture ggx.h5 -o none/a.png"), "none/a.png");
  check_one_line_failure(folder.run("picture ggx.h5 -o folder.png"), "folder.png");
  check_one_line_failure(folder.run("bench --json none/a.json"), "none/a.json");
  check_one_line_failure(folder.run("bench --plot none/a.svg"), "none/a.svg");
  check_one_line_failure(folder.run("validate ggx.h5 --thorough --json none/a.json"), "none");
  check_one_line_failure(folder.run("validate ggx.h5 --thorough --json ./ggx.h5"), "also read");
  fs::rename(folder / "ggx.h5", folder / "map.exr");
  check_one_line_failure(folder.run("build --normal-map map.exr -o map.exr"), "also read");
  CHECK(content(folder / "map.exr") == tables);
  CHECK(folder.files().size() == 3);
}

TEST_CASE("what was printed to a full disk is not taken for success") {
  const FolderWithTables folder;
  for (const std::string command : {"info ggx.h5", "build --list", "validate --list",
                                    "sample ggx.h5 --wi 0,0,1 --alpha 1 -n 10000000"}) {
    CAPTURE(command);
    const Result r = folder.run_on_full_disk(command);
    CHECK(r.status == 1);
    CHECK_THAT(r.error, contains("cannot write to standard output"));
  }
}

TEST_CASE("info shows what a file holds, for people and as JSON") {
  const FolderWithTables folder;
  CHECK_THAT(folder.run("info ggx.h5").out, contains("ggx") && contains("32 x 48") &&
                                                contains("vndf build ggx -o ggx.h5 --size 32x48"));
  const auto json = nlohmann::json::parse(folder.run("info ggx.h5 --json").out);
  CHECK(json.at("distribution") == "ggx");
  CHECK(json.at("mean_slope").get<double>() == Approx(1));
  CHECK(json.at("certificate").size() == 36);
}

TEST_CASE("a file that is not there or not a table is refused") {
  const FolderWithTables folder;
  std::ofstream(folder / "foreign.h5") << "not a table";
  check_one_line_failure(folder.run("info missing.h5"), "missing.h5");
  check_one_line_failure(folder.run("sample foreign.h5 --wi 0,0,1 --alpha 1"), "foreign.h5");
  check_one_line_failure(folder.run("convert foreign.h5 out.exr"), "foreign.h5");
  check_one_line_failure(folder.run("convert ggx.h5 out.png"), "out.png");
  CHECK_FALSE(fs::exists(folder / "out.exr"));
}

TEST_CASE("sample prints CSV with the header, from a seed") {
  const FolderWithTables folder;
  const std::string command = "sample ggx.h5 --wi -0.6,0,0.8 --alpha 0.3,0.1 -n 5 --seed ";
  const Result r = folder.run(command + "7");
  std::istringstream lines(r.out);
  std::string line;
  std::getline(lines, line);
  CHECK(line == "u1,u2,slope_x,slope_y,mx,my,mz,pdf");
  int count = 0;
  while (std::getline(lines, line)) {
    const auto v = numbers(line, ',');
    REQUIRE(v.size() == 8);
    CHECK(v[2] == Approx(-v[4] / v[6]).margin(1e-6));
    CHECK(v[3] == Approx(-v[5] / v[6]).margin(1e-6));
    CHECK(-0.6 * v[4] + 0.8 * v[6] >= 0);
    CHECK(v[7] > 0);
    ++count;
  }
  CHECK(count == 5);
  CHECK(folder.run(command + "7").out == r.out);
  CHECK(folder.run(command + "8").out != r.out);
}

TEST_CASE("sample brings the direction to unit length") {
  const FolderWithTables folder;
  CHECK(folder.run("sample ggx.h5 --wi 3,0,4 --alpha 0.5").out ==
        folder.run("sample ggx.h5 --wi 0.6,0,0.8 --alpha 0.5").out);
}

TEST_CASE("sample --stdin answers each line with the slopes, the normal and the density") {
  const FolderWithTables folder;
  const Result r =
      folder.run("sample ggx.h5 --stdin", "0.6 0 0.8 1 1 0.25 0.75\n0 0 1 1 1 0.5 0.5\n");
  std::istringstream lines(r.out);
  std::string line;
  std::getline(lines, line);
  const auto first = numbers(line);
  REQUIRE(first.size() == 6);
  CHECK(first[0] < 4.0 / 3);
  CHECK(first[1] > 0);
  std::getline(lines, line);
  const auto second = numbers(line);
  CHECK(second[0] == Approx(0).margin(1e-5));
  CHECK(second[1] == Approx(0).margin(1e-5));
  CHECK(second[5] == Approx(0.318309886).epsilon(1e-5));
  CHECK_FALSE(std::getline(lines, line));
}

TEST_CASE("the ends of u1 are minus infinity and cot(theta)") {
  const FolderWithTables folder;
  const Result r =
      folder.run("sample ggx.h5 --stdin", "0.6 0 0.8 1 1 0 0.5\n0.6 0 0.8 1 1 1 0.5\n");
  CHECK_THAT(r.out, contains("-inf "));
  // Between the rows of tables of 32 x 48 the end errs like everything else, by 5.5e-5 here.
  CHECK(numbers(r.out.substr(r.out.find('\n') + 1))[0] == Approx(4.0 / 3).epsilon(1e-4));
}

TEST_CASE("sample --double answers in double precision") {
  const FolderWithTables folder;
  const std::string line = "0.6 0 0.8 0.4 0.4 0.25 0.75\n";
  const auto in_float = numbers(folder.run("sample ggx.h5 --stdin", line).out);
  const auto in_double = numbers(folder.run("sample ggx.h5 --stdin --double", line).out);
  for (std::size_t i = 0; i < 6; ++i) {
    CHECK(in_float[i] == Approx(in_double[i]).epsilon(1e-5));
    CHECK(in_float[i] != in_double[i]);
  }
}

TEST_CASE(
    "a line of standard input that cannot be sampled is named; those before it are answered") {
  const FolderWithTables folder;
  const std::string good = "0.6 0 0.8 1 1 0.25 0.75\n";
  const auto refused = [&](const std::string& line, const std::string& why) {
    const Result r = folder.run("sample ggx.h5 --stdin", good + line + "\n" + good);
    CHECK(r.status == 1);
    CHECK(std::count(r.out.begin(), r.out.end(), '\n') == 1);
    CHECK_THAT(r.error, contains("line 2") && contains(why));
  };
  refused("0.6 0 0.8 1 1 0.25", "seven numbers");
  refused("0.6 0 0.8 1 1 0.25 0.5 9", "seven numbers");
  refused("0.6 0 x 1 1 0.25 0.5", "seven numbers");
  refused("0.6 0 0.9 1 1 0.25 0.5", "length 1");
  refused("0.6 0 0.8 0 1 0.25 0.5", "alpha");
  refused("0.6 0 0.8 1 1 1.25 0.5", "[0, 1]");
  refused("0.6 0 0.8 1 1 nan 0.5", "[0, 1]");
}

TEST_CASE("converted tables give the same samples") {
  const FolderWithTables folder;
  REQUIRE(folder.run("convert ggx.h5 ggx.exr").status == 0);
  REQUIRE(folder.run("convert ggx.exr back.h5").status == 0);
  const std::string arguments = " --wi 0.3,0.5,0.4 --alpha 0.3,0.1 -n 200";
  const std::string samples = folder.run("sample ggx.h5" + arguments).out;
  CHECK(folder.run("sample ggx.exr" + arguments).out == samples);
  CHECK(folder.run("sample back.h5" + arguments).out == samples);
  CHECK(content(folder / "back.h5") == content(folder / "ggx.h5"));
}

TEST_CASE("a picture of the tables is drawn") {
  const FolderWithTables folder;
  REQUIRE(folder.run("picture ggx.h5 -o tables.png").status == 0);
  CHECK(content(folder / "tables.png").substr(1, 3) == "PNG");
  check_one_line_failure(folder.run("picture ggx.h5 -o tables.gif"), "tables.gif");
}

TEST_CASE("without gnuplot a picture is refused in words, and nothing is left behind") {
  const FolderWithTables folder;
  const std::string path = std::getenv("PATH");
  setenv("PATH", "/nonexistent", 1);
  const Result r = folder.run("picture ggx.h5 -o tables.png");
  setenv("PATH", path.c_str(), 1);
  check_failure(r, 1, "vndf: tables.png: gnuplot did not draw it; is it installed");
  CHECK(folder.files() == std::vector<std::string>{"ggx.h5"});
}

TEST_CASE("bench --quick prints a table, writes JSON and draws the picture") {
  const Folder folder;
  const Result r = folder.run(
      "bench --quick --repetitions 1 --distribution ggx --only 'linear 16' hemisphere "
      "--json speed.json --plot speed.svg");
  CHECK(r.status == 0);
  CHECK_THAT(r.out, contains("ggx caps as published") && contains("ggx linear 16") &&
                        contains("ggx hemisphere") && contains("u-error"));
  const auto json = nlohmann::json::parse(content(folder / "speed.json"));
  CHECK(json.at("entries").size() == 3);
  CHECK(json.at("repetitions") == 1);
  CHECK_THAT(content(folder / "speed.svg"), contains("<svg") && contains("Pareto front"));
}

TEST_CASE("bench refuses what it cannot do before it times anything") {
  const Folder folder;
  check_one_line_failure(folder.run("bench --quick --only qubic"), "'qubic'");
  check_one_line_failure(folder.run("bench --quick --distribution gxx"), "'gxx'");
  check_one_line_failure(folder.run("bench --quick --plot speed.gif"), "speed.gif");
  check_failure(folder.run("bench --repetitions 0"), 2, "--repetitions");
  CHECK(folder.files().empty());
}

TEST_CASE("build --list names every family with its parameters") {
  const Folder folder;
  const Result r = folder.run("build --list");
  CHECK(r.status == 0);
  for (const char* name : {"beckmann", "ggx", "student-t", "exponential-power", "hyper-cauchy", "k",
                           "disk", "pearson-ii", "annulus", "blinn-phong", "mixture"})
    CHECK_THAT(r.out, contains(name));
  CHECK_THAT(r.out, contains("gamma=2.5 (1.55 to 1e+06)"));
}

TEST_CASE("a file says which distribution it holds and how it was made, whatever the kind") {
  const Folder folder;
  const std::vector<std::pair<std::string, std::string>> sources = {
      {"student-t", "student-t:gamma=2.5"},
      {"'mixture:0.7*ggx+0.3*beckmann@0.2' --name \"it's\"",
       "mixture:0.7*ggx+0.3*beckmann@0.2 name:'it''s'"},
      {"--p22 'exp(-k*r^2)' --param k=2.5 --name mine",
       "p22:'exp(-k*r^2)' param:k=2.5 name:'mine'"},
      {"--p22 'r < 1 ? 1 : exp(-r)' --break 1", "p22:'r < 1 ? 1 : exp(-r)' break:1"},
      {"--ndf 'alpha^2/(cos(theta)^2*(alpha^2-1)+1)^2'",
       "ndf:'alpha^2/(cos(theta)^2*(alpha^2-1)+1)^2'"},
      {"--ndf 'cos(theta)^(2/alpha^2-2)' --frozen-at 0.3",
       "ndf:'cos(theta)^(2/alpha^2-2)' frozen-at:0.3"}};
  for (const auto& [source, specification] : sources) {
    CAPTURE(source);
    REQUIRE(folder.run("build " + source + " -o a.h5 --size 24 --quiet").status == 0);
    const auto info = nlohmann::json::parse(folder.run("info a.h5 --json").out);
    CHECK(info.at("specification") == specification);
    CHECK_THAT(info.at("command").get<std::string>(), contains(" -o a.h5 --size 24"));
  }
  CHECK_THAT(folder.run("info a.h5").out,
             contains("frozen-at:0.3") && contains("not a family in alpha"));
  CHECK(folder.run("validate a.h5 --quick --seed 1").error.empty());
}

TEST_CASE("the command in a file leaves out what does not change the file") {
  const Folder folder;
  REQUIRE(folder.run("build ggx --threads 2 --size=16 --name 'a b' -o a.h5 --json").status == 0);
  const auto info = nlohmann::json::parse(folder.run("info a.h5 --json").out);
  CHECK(info.at("command") == "vndf build ggx --size=16 --name 'a b' -o a.h5");
}

TEST_CASE("the command in a file has no control characters, whatever the names of files are") {
  const Folder folder;
  REQUIRE(folder.run("build ggx --size 16 -o \"$(printf '\\033')'.h5\" --quiet").status == 0);
  fs::rename(folder / "\x1b'.h5", folder / "a.h5");
  const auto info = nlohmann::json::parse(folder.run("info a.h5 --json").out);
  CHECK(info.at("command") == R"(vndf build ggx --size 16 -o $'\x1b\x27.h5')");
}

namespace {

void write_profile(const fs::path& path) {
  std::ofstream csv(path);
  csv << "r,p22\n";
  for (double r = 0; r < 20; r = r * 1.1 + 0.02) csv << r << ',' << std::pow(1 + r * r, -2) << '\n';
}

/// A map of 128 x 128 normally distributed slopes.
void write_map(const fs::path& path) {
  constexpr std::size_t kSide = 128;
  std::mt19937 random(7);
  std::normal_distribution<float> normal;
  vndf::io::ExrImage map{.width = kSide, .height = kSide};
  for (const char* channel : {"slope_x", "slope_y"})
    for (std::size_t i = 0; i < kSide * kSide; ++i)
      map.channels[channel].push_back(0.3f * normal(random));
  std::ofstream(path, std::ios::binary) << vndf::io::write_exr_image(map);
}

}  // namespace

TEST_CASE("tables of a profile are validated anywhere, without its file") {
  const Folder folder;
  write_profile(folder / "p.csv");
  REQUIRE(folder.run("build --profile p.csv --tail power -o a.h5 --size 64 --quiet").status == 0);
  REQUIRE(folder.run("convert a.h5 a.exr").status == 0);
  REQUIRE(folder.run("bake a.h5 -o a.vndf --tolerance 1e-4 --quiet").error.empty());
  fs::remove(folder / "p.csv");
  fs::create_directory(folder / "elsewhere");
  CHECK_THAT(folder.run("info a.h5").out, contains("profile tail:power=3.9") &&
                                              contains("name:'p', ") && contains(" samples\n") &&
                                              contains("--profile p.csv"));
  for (const std::string file : {"../a.h5", "../a.exr", "../a.vndf"}) {
    CAPTURE(file);
    const Result r = folder.run_in("elsewhere", "validate " + file + " --quick --seed 1");
    CHECK(r.error.empty());
    CHECK(r.status == 0);
    CHECK_THAT(folder.run_in("elsewhere", "check none.csv --against " + file).error,
               contains("none.csv"));
  }
}

TEST_CASE("tables of a map are validated anywhere, without its file") {
  const Folder folder;
  write_map(folder / "m.exr");
  REQUIRE(folder.run("build --normal-map m.exr -o a.h5 --size 64 --quiet").status == 0);
  REQUIRE(folder.run("bake a.h5 -o a.vndf --tolerance 1e-3 --quiet").error == "");
  fs::remove(folder / "m.exr");
  fs::create_directory(folder / "elsewhere");
  for (const std::string file : {"../a.h5", "../a.vndf"}) {
    CAPTURE(file);
    const Result r = folder.run_in("elsewhere", "validate " + file + " --quick --seed 1");
    CHECK(r.error.empty());
    CHECK(r.status == 0);
  }
}

TEST_CASE("what a map holds is reported, and an encoding of what has none is refused") {
  const Folder folder;
  write_map(folder / "m.exr");
  const std::string build = "build --normal-map m.exr -o a.h5 --size 16";
  CHECK_THAT(folder.run(build).out, contains("image: EXR, slopes, 128 x 128 texels"));
  CHECK_THAT(folder.run("info a.h5").out, contains("image: EXR, slopes, 128 x 128 texels"));
  check_one_line_failure(folder.run(build + " --encoding plain"),
                         "it holds slopes, which have no encoding");
  std::ofstream(folder / "m.png") << "not a picture";
  check_one_line_failure(folder.run("build --normal-map m.png -o b.h5"),
                         "m.png: it is none of the images that are read; give an EXR, PNG or TIFF");
}

TEST_CASE("a profile with the marks and line ends of other systems is the same profile") {
  const Folder folder;
  std::string plain = "r,p22\n", marked = "\xEF\xBB\xBFr,p22\r\n";
  for (int k = 0; k < 20; ++k) {
    const std::string line = std::to_string(k) + "," + std::to_string(std::exp(-k));
    plain += line + "\n";
    marked += line + "\r\n";
  }
  std::ofstream(folder / "p.csv", std::ios::binary) << plain;
  REQUIRE(folder.run("build --profile p.csv -o a.exr --size 16 --quiet").status == 0);
  std::ofstream(folder / "p.csv", std::ios::binary) << marked;
  REQUIRE(folder.run("build --profile p.csv -o b.exr --size 16 --quiet").status == 0);
  const std::string sample = " --wi 0.6,0,0.8 --alpha 1 -n 50";
  CHECK(folder.run("sample a.exr" + sample).out == folder.run("sample b.exr" + sample).out);
}

TEST_CASE("tables that err by more than 1e-3 are not written in silence") {
  const Folder folder;
  const Result coarse = folder.run("build ggx -o a.h5 --size 8");
  CHECK(coarse.status == 0);
  CHECK_THAT(coarse.error, contains("warning: the marginal table errs by up to"));
  CHECK(folder.run("build ggx -o a.h5 --size 64").error.empty());
}

TEST_CASE("what is wrong with a distribution is told before any work, in one line") {
  const Folder folder;
  const auto refused = [&](const std::string& source, const std::string& why) {
    CAPTURE(source);
    check_one_line_failure(folder.run("build " + source + " -o a.h5"), why);
  };
  refused("student-t:gamma=1.5", "gamma");
  refused("student-t:gama=2", "did you mean 'gamma'");
  refused("studnt-t", "did you mean 'student-t'");
  refused("mixture:0.7*ggx+0.3*", "column");
  refused("--p22 'exp(-r^2'", "column");
  refused("--p22 'exp(-q*r)'", "'q'");
  refused("--p22 'exp(-r^2)' --param k=2", "'k'");
  refused("--p22 '(1-r)*exp(-r)'", "p22 is -");
  refused("--p22 '1/(1+r^2)'", "does not converge");
  refused("--p22 'r < 1 ? 1 : exp(-r)'", "--break");
  refused("--p22 '(1+r^2)^(-1.5)'", "mean slope");
  refused("--p22 'exp(-r)/r'", "infinite at slope radius 0");
  refused("--ndf 'cos(theta)^(2/alpha^2-2)'", "--frozen-at");
  refused("--ndf '1/(cos(theta)^2*(alpha^2-1)+1)^3'", "--frozen-at");
  refused("--profile missing.csv", "missing.csv: there is no such file");
  refused("--profile .", ".: it is not a file");
  std::ofstream(folder / "bad.csv") << "r,p22\n0,1\n0.5,0.5\n0.4,0.3\n1,0.1\n";
  refused("--profile bad.csv", "4");
  fs::remove(folder / "bad.csv");
  CHECK(folder.files().empty());
}

TEST_CASE("a profile that no table could hold is refused before any work") {
  const Folder folder;
  const auto refused = [&](const std::string& samples, const std::string& why) {
    CAPTURE(samples);
    std::ofstream(folder / "p.csv") << "r,p22\n" << samples;
    for (const std::string tail : {"none", "exponential", "power"}) {
      const auto start = std::chrono::steady_clock::now();
      check_one_line_failure(folder.run("build --profile p.csv --tail " + tail + " -o a.h5"), why);
      // It takes 20 ms; the work that was done before such a refusal took from 2 to 98 s.
      CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(1));
    }
  };
  refused("0,1\n1,1e308\n2,1e308\n3,1\n", "sample 2 (r = 1, p22 = 1e+308)");
  refused("0,1\n1,1e308\n2,1e308\n3,1e-308\n4,1e-320\n", "use other units");
  refused("0,1e-300\n1,1e300\n1.0000000000000002,1e-300\n5,1e-300\n", "use other units");
  refused("0,1\n1,10\n1.0000000000000002,1\n5,0.1\n", "differs from the one before by less");
  refused("0,2\n1e-6,6\n0.07,0.4\n7e7,1e-230\n",
          "end the profile where nothing of the mass is left");
}

TEST_CASE("a long profile is resampled, a noisy one smoothed on request, and both are reported") {
  const Folder folder;
  {
    std::ofstream csv(folder / "p.csv");
    csv << "r,p22\n";
    for (int i = 0; i < 1000; ++i)
      csv << i / 200.0 << ',' << std::exp(-i * i / 4e4) * (1 + 0.01 * std::sin(1e3 * i)) << '\n';
  }
  const auto build = [&](const std::string& options) {
    const Result built = folder.run("build --profile p.csv -o a.h5 --size 16" + options);
    CHECK(built.status == 0);
    return built.out;
  };
  CHECK_THAT(build(""), contains("resampled: 254 samples in place of 1000, CDF of slopes within"));
  CHECK_THAT(folder.run("info a.h5").out, contains("resampled: 254 samples in place of 1000"));
  CHECK_THAT(build(" --smooth"), contains("smoothed: ") && contains("in place of 1000, CDF") &&
                                     contains("p22 within 7.") && !contains("resampled"));
  CHECK_THAT(folder.run("info a.h5").out, contains("smoothed: "));
}

TEST_CASE("options that do not go together are wrong usage") {
  const Folder folder;
  check_failure(folder.run("build ggx --p22 'exp(-r)' -o a.h5"), 2, "one of");
  check_failure(folder.run("build ggx --param k=2 -o a.h5"), 2, "--param");
  check_failure(folder.run("build --p22 'exp(-k*r)' --param k -o a.h5"), 2, "NAME=NUMBER");
  check_failure(folder.run("build ggx --break 1 -o a.h5"), 2, "--break");
  check_failure(folder.run("build ggx --frozen-at 0.3 -o a.h5"), 2, "--frozen-at");
  check_failure(folder.run("build ggx --tail power -o a.h5"), 2, "--tail: goes with --profile");
  check_failure(folder.run("build ggx --smooth -o a.h5"), 2, "--smooth: goes with --profile");
  check_failure(folder.run("build ggx --encoding plain -o a.h5"), 2,
                "--encoding: goes with --normal-map");
  check_failure(folder.run("build --profile p.csv --ignore-asymmetry -o a.h5"), 2,
                "--ignore-asymmetry: goes with --normal-map");
  check_failure(folder.run("build ggx --json --quiet -o a.h5"), 2, "--quiet");
  check_failure(folder.run("build --list --size 64"), 2, "--size excludes --list");
  check_failure(folder.run("validate --list --quick"), 2, "--quick excludes --list");
  check_failure(folder.run("check r.csv --against ggx --inverse no --u-error 1e-3"), 2,
                "--u-error: bounds the map");
  check_failure(folder.run("check r.csv --against ggx --force"), 2, "--json");
  check_failure(folder.run("validate ggx-caps --force"), 2, "--json");
  check_failure(folder.run("experiment variance --distribution ggx --light smooth --lamp 1,2"), 2,
                "--lamp: places the lamp");
}

TEST_CASE("the variance experiment tells the gain of visible normals, from a name or from a file") {
  const Folder folder;
  REQUIRE(folder.run("build ggx -o t.h5 --size 64 --quiet").status == 0);
  const std::string options = " --samples 1e5 --theta 80 --alpha 0.5 --light smooth";
  const Result text = folder.run("experiment variance --distribution ggx" + options);
  REQUIRE(text.status == 0);
  CHECK_THAT(text.out, contains("algorithm-2-tables"));
  CHECK(text.error.empty());

  const Result json = folder.run("experiment variance --tables t.h5 --json" + options);
  REQUIRE(json.status == 0);
  const auto report = nlohmann::json::parse(json.out);
  const auto& estimators = report["lights"][0]["estimators"];
  CHECK(report["lights"].size() == 1);
  CHECK(estimators[0]["estimator"] == "algorithm-1");
  CHECK(estimators[0]["gain_over_algorithm_1"] == 1);
  std::size_t visible = 0;
  for (const auto& e : estimators) {
    if (!e["visible_normals"]) continue;
    ++visible;
    CHECK(e["gain_over_algorithm_1"] > 1.5);
    CHECK(e["largest_weight"] <= 1);
  }
  CHECK(visible == 5);  // analytic, exact, caps, tables; V-cavities
  CHECK(folder.run("experiment variance --tables t.h5 --json --threads 1" + options).out ==
        json.out);
}

TEST_CASE("the variance experiment refuses what it cannot run") {
  const Folder folder;
  check_failure(folder.run("experiment"), 2, "subcommand");
  check_failure(folder.run("experiment variance"), 2, "--distribution or --tables");
  check_failure(folder.run("experiment variance --distribution ggx --tables t.h5"), 2, "excludes");
  check_failure(folder.run("experiment variance --distribution ggx --samples 1.5"), 2, "1.5");
  check_failure(folder.run("experiment variance --distribution ggx --samples 0"), 2, "'0'");
  check_one_line_failure(folder.run("experiment variance --tables missing.h5"), "missing.h5");
  check_one_line_failure(folder.run("experiment variance --distribution ggx --theta 95"), "theta");
  check_one_line_failure(folder.run("experiment variance --distribution ggx --alpha 0"), "alpha");
  check_one_line_failure(folder.run("experiment variance --distribution ggx --lamp 30,nan"),
                         "lamp");
}
