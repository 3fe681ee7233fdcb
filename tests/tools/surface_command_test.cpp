// The program on surfaces with correlated slopes or a mean slope, and on those of maps.
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "support/catch.h"
#include "support/program_folder.h"
#include "vndf/io/exr_image.h"

namespace fs = std::filesystem;
using vndf::test::Approx;
using vndf::test::contains;
using vndf::test::Folder;
using vndf::test::FolderWithTables;
using vndf::test::Result;

namespace {

using Row = std::vector<double>;

/// The numbers of the lines of `text` but for the first, which is `header`.
std::vector<Row> rows_of(const std::string& text, const std::string& header) {
  std::istringstream lines(text);
  std::string line;
  std::getline(lines, line);
  CHECK(line == header);
  std::vector<Row> rows;
  while (std::getline(lines, line)) {
    std::istringstream fields(line);
    rows.emplace_back();
    for (std::string field; std::getline(fields, field, ',');)
      rows.back().push_back(std::stod(field));
  }
  return rows;
}

void check_usage(const Result& r, const std::string& message) {
  CHECK(r.status == 2);
  CHECK_THAT(r.error, contains(message));
  CHECK(r.out.empty());
}

void check_failure(const Result& r, const std::string& message) {
  CHECK(r.status == 1);
  CHECK_THAT(r.error, contains(message));
  CHECK(r.out.empty());
}

constexpr char kTilted[] = "wx,wy,wz,ax,ay,correlation,mean_x,mean_y,u1,u2,mx,my,mz,pdf";
constexpr char kFlat[] = "wx,wy,wz,ax,ay,u1,u2,mx,my,mz,pdf";

/// The density of visible GGX normals of a row with the columns of kTilted, in closed form: slopes
/// have the density 1 / (pi |C|^1/2 (1 + q)^2), q = (x - mean)^T C^-1 (x - mean), and the facets
/// that face w show it the area (h + sqrt(h^2 + w^T C w)) / 2 with h that of the mean facet.
double ggx_density(const Row& row) {
  const double wx = row[0], wy = row[1], wz = row[2], mx = row[10], my = row[11], mz = row[12];
  const double xx = row[3] * row[3], yy = row[4] * row[4], xy = row[5] * row[3] * row[4];
  const double x = -mx / mz - row[6], y = -my / mz - row[7], determinant = xx * yy - xy * xy;
  const double q = (yy * x * x - 2 * xy * x * y + xx * y * y) / determinant;
  const double h = wz - row[6] * wx - row[7] * wy;
  const double area = (h + std::sqrt(h * h + xx * wx * wx + 2 * xy * wx * wy + yy * wy * wy)) / 2;
  return (wx * mx + wy * my + wz * mz) / area /
         (std::numbers::pi * std::sqrt(determinant) * (1 + q) * (1 + q) * std::pow(mz, 4));
}

/// A map of slopes that are normally distributed about a mean with a correlation of 0.8.
void write_tilted_map(const fs::path& path) {
  constexpr std::size_t kSide = 128;
  std::mt19937 random(7);
  std::normal_distribution<float> normal;
  vndf::io::ExrImage map{.width = kSide, .height = kSide};
  for (std::size_t i = 0; i < kSide * kSide; ++i) {
    const float a = normal(random), b = normal(random);
    map.channels["slope_x"].push_back(0.5f + 0.4f * a);
    map.channels["slope_y"].push_back(-0.25f + 0.2f * (0.8f * a + 0.6f * b));
  }
  std::ofstream(path, std::ios::binary) << vndf::io::write_exr_image(map);
}

/// The surface that `vndf info` says of a file.
nlohmann::json surface_of(const Folder& folder, const std::string& file) {
  return nlohmann::json::parse(folder.run("info --json " + file).out).at("surface");
}

/// The options of vndf sample that describe a surface.
std::string options_of(const nlohmann::json& surface) {
  const auto two = [](const nlohmann::json& v) { return v[0].dump() + "," + v[1].dump(); };
  return " --alpha " + two(surface.at("alpha")) + " --correlation " +
         surface.at("correlation").dump() + " --mean " + two(surface.at("mean"));
}

}  // namespace

TEST_CASE("records of any surface have the density of its visible normals") {
  const FolderWithTables folder;
  // The density is from curves, which are as exact in small tables.
  constexpr double kCurves = 1e-4;
  for (const std::string wi : {"0.6,0,0.8", "-0.3,0.9,0.2", "0.6,0.48,-0.64"})
    for (const std::string surface :
         {"--correlation 0.5", "--mean -0.5,2", "--rotate 30 --mean 1,0",
          "--correlation -0.95 --mean 0,-1"}) {
      CAPTURE(wi, surface);
      const Result r =
          folder.run("sample ggx.h5 --records --alpha 0.5,0.2 -n 20 --wi " + wi + " " + surface);
      CHECK(r.error.empty());
      const auto rows = rows_of(r.out, kTilted);
      REQUIRE(rows.size() == 20);
      for (const Row& row : rows) {
        REQUIRE(row.size() == 14);
        CHECK(row[13] == Approx(ggx_density(row)).epsilon(kCurves));
        CHECK(row[0] * row[10] + row[1] * row[11] + row[2] * row[12] >= -1e-6);
      }
    }
}

TEST_CASE("a flat surface needs no columns of its own, and a quarter turn leaves it flat") {
  const FolderWithTables folder;
  const std::string sample = "sample ggx.h5 --records --wi 0.6,0,0.8 --alpha ";
  const std::string plain = folder.run(sample + "0.1,0.3").out;
  REQUIRE(rows_of(plain, kFlat).size() == 10);
  CHECK(folder.run(sample + "0.1,0.3 --correlation 0 --mean 0,0").out == plain);
  CHECK(folder.run(sample + "0.3,0.1 --rotate 90").out == plain);
  CHECK(folder.run(sample + "0.1,0.3 --rotate 45").out != plain);
}

TEST_CASE("a line of ten numbers is drawn on its surface") {
  const FolderWithTables folder;
  const auto rows = rows_of(folder
                                .run("sample ggx.h5 --records --wi 0.6,0,0.8 --alpha 0.5,0.2 "
                                     "--correlation 0.5 --mean 1,-0.25 -n 1")
                                .out,
                            kTilted);
  REQUIRE(rows.size() == 1);
  const Row& row = rows[0];
  std::ostringstream line;
  line.precision(9);
  line << "0.6 0 0.8 0.5 0.2 0.5 1 -0.25 " << row[8] << ' ' << row[9] << '\n';
  std::istringstream answer(folder.run("sample ggx.h5 --stdin", line.str()).out);
  const std::vector<double> numbers{std::istream_iterator<double>(answer), {}};
  REQUIRE(numbers.size() == 6);
  for (std::size_t i = 0; i < 4; ++i) CHECK(numbers[2 + i] == row[10 + i]);
}

TEST_CASE("options that make no surface are wrong usage") {
  const Folder folder;  // told before the file is read
  const auto refused = [&](const std::string& options, const std::string& message) {
    CAPTURE(options);
    check_usage(folder.run("sample none.h5 --wi 0,0,1 --alpha 0.5 " + options), message);
  };
  refused("--correlation 1", "'1' is not a number inside (-1, 1)");
  refused("--correlation nan", "'nan'");
  refused("--mean 1", "--mean");
  refused("--mean 1,inf", "'inf' is not a finite number");
  refused("--mean 1e39,0", "beyond single precision; give --double");
  refused("--rotate x", "'x' is not a finite number");
  refused("--rotate 10 --correlation 0.5", "--correlation excludes --rotate");
  refused("--stdin --mean 1,0", "excludes --stdin");
  for (const std::string other : {"--mean 0,0", "--rotate 1", "--correlation 0", ""})
    refused("--as-mapped " + other, "excludes --as-mapped");
  check_usage(folder.run("sample none.h5 --wi 0,0,1 --alpha 1,1e-9 --rotate 45"),
              "the correlation must be inside (-1, 1)");
}

TEST_CASE("directions below the horizon need tables that have them") {
  const FolderWithTables folder;
  REQUIRE(folder.run("bake ggx.h5 -o all.vndf --tolerance 1e-3 --quiet").status == 0);
  REQUIRE(folder.run("bake ggx.h5 -o above.vndf --above-only --tolerance 1e-3 --quiet").status ==
          0);
  // From behind the mean facet though above the horizon, the reverse, and from straight below.
  for (const std::string options :
       {"--wi 0.8,0,0.6 --mean 1,0", "--wi 0.6,0,-0.8", "--wi 0,0,-1"}) {
    CAPTURE(options);
    CHECK(folder.run("sample all.vndf --alpha 1 " + options).status == 0);
    check_failure(folder.run("sample above.vndf --alpha 1 " + options),
                  "above.vndf: wi is behind the mean facet, and the tables were baked with "
                  "--above-only; bake them without it");
  }
  CHECK(folder.run("sample above.vndf --alpha 1 --wi 0.8,0,-0.6 --mean -1,0").status == 0);
  CHECK_THAT(folder.run("sample above.vndf --stdin", "0 0 -1 1 1 0.5 0.5\n").error,
             contains("line 1: wi is behind the mean facet"));
}

TEST_CASE(
    "tables of a map record its surface in every format, and sample --as-mapped draws on it") {
  const Folder folder;
  write_tilted_map(folder / "slopes.exr");
  REQUIRE(folder.run("build --normal-map slopes.exr -o map.h5 --size 32 --quiet").status == 0);
  REQUIRE(folder.run("convert map.h5 map.exr").status == 0);
  REQUIRE(folder.run("bake map.h5 -o map.vndf --tolerance 0.01 --quiet").status == 0);
  const auto surface = surface_of(folder, "map.h5");
  // E|z| of the normal distribution is sqrt(2 / pi); 16384 texels know it to about one per cent.
  const double unit = std::sqrt(2 / std::numbers::pi);
  CHECK(surface.at("alpha")[0].get<double>() == Approx(0.4 * unit).epsilon(0.03));
  CHECK(surface.at("alpha")[1].get<double>() == Approx(0.2 * unit).epsilon(0.03));
  CHECK(surface.at("correlation").get<double>() == Approx(0.8).margin(0.02));
  CHECK(surface.at("mean")[0].get<double>() == Approx(0.5).margin(0.02));
  CHECK(surface.at("mean")[1].get<double>() == Approx(-0.25).margin(0.01));
  for (const std::string file : {"map.h5", "map.exr", "map.vndf"}) {
    CAPTURE(file);
    CHECK(surface_of(folder, file) == surface);
    CHECK_THAT(folder.run("info " + file).out, contains("surface of the map      alpha 0.3"));
    const std::string sample = "sample " + file + " --records --wi 0.6,0,0.8";
    const std::string out = folder.run(sample + " --as-mapped").out;
    CHECK(rows_of(out, kTilted).size() == 10);
    CHECK(folder.run(sample + options_of(surface)).out == out);
  }
}

TEST_CASE("--as-mapped is refused where the tables record no surface") {
  const FolderWithTables folder;
  check_failure(folder.run("sample ggx.h5 --wi 0,0,1 --as-mapped"),
                "ggx.h5: it records no surface, because it was not made from a map; give --alpha, "
                "--correlation and --mean in place of --as-mapped");
}
