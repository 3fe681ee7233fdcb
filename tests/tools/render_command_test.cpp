// Pictures on the command line: what is rendered, and what is refused before anything is written.
#include <filesystem>
#include <fstream>
#include <string>

#include "support/catch.h"
#include "support/program_folder.h"
#include "vndf/io/exr_image.h"
#include "vndf/io/radiance_image.h"

namespace fs = std::filesystem;
using vndf::test::contains;
using vndf::test::content;
using vndf::test::Folder;
using vndf::test::Result;

namespace {

const std::string kTiny = " --size 8x6 --spp 2 ";

/// Nothing is written, and one line on standard error tells why.
void check_refused(const Folder& folder, const std::string& arguments, int status,
                   const std::string& message) {
  const std::size_t before = folder.files().size();
  const Result r = folder.run("render " + arguments);
  CAPTURE(arguments, r.error);
  CHECK(r.status == status);
  CHECK_THAT(r.error, contains(message));
  CHECK(r.out.empty());
  CHECK(folder.files().size() == before);
}

void write(const fs::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

/// The mean of the values of an EXR file of radiance.
double mean(const fs::path& path) {
  const auto image = vndf::io::read_radiance_image(path);
  double sum = 0;
  for (const float v : image.values) sum += static_cast<double>(v);
  return sum / static_cast<double>(image.values.size());
}

/// An octahedron, half of it below the plane z = 0.
constexpr const char* kOctahedron =
    "v 1 0 0\nv 0 1 0\nv -1 0 0\nv 0 -1 0\nv 0 0 1\nv 0 0 -1\n"
    "f 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\nf 2 1 6\nf 3 2 6\nf 4 3 6\nf 1 4 6\n";

}  // namespace

TEST_CASE("every scene is rendered to both kinds of picture") {
  const Folder folder;
  write(folder / "body.obj", kOctahedron);
  for (const char* scene : {"plate", "plate-beckmann", "pedestal", "ball", "body.obj"}) {
    const Result r = folder.run("render " + std::string(scene) + " -o a.exr" + kTiny);
    CAPTURE(scene, r.error);
    REQUIRE(r.status == 0);
    CHECK_THAT(r.out, contains("a.exr: 8 x 6 pixels, 2 samples each"));
    const auto image = vndf::io::read_radiance_image(folder / "a.exr");
    CHECK(image.width == 8);
    CHECK(image.height == 6);
    REQUIRE(
        folder.run("render " + std::string(scene) + " -o a.png" + kTiny + "--quiet").out.empty());
    CHECK(content(folder / "a.png").starts_with("\x89PNG"));
  }
}

TEST_CASE("the same options give the same file, whatever the number of threads") {
  const Folder folder;
  const std::string ball = "render ball" + kTiny;
  REQUIRE(folder.run(ball + "-o a.exr --threads 1").status == 0);
  REQUIRE(folder.run(ball + "-o b.exr --threads 3").status == 0);
  REQUIRE(folder.run(ball + "-o c.exr --seed 2").status == 0);
  CHECK(content(folder / "a.exr") == content(folder / "b.exr"));
  CHECK(content(folder / "a.exr") != content(folder / "c.exr"));
}

TEST_CASE("tables of both kinds look like the closed form, in every sampling") {
  const Folder folder;
  REQUIRE(folder.run("build ggx -o ggx.h5 --size 64 --quiet").status == 0);
  REQUIRE(folder.run("bake ggx.h5 -o ggx.vndf --tolerance 1e-4 --quiet").status == 0);
  const std::string options =
      " --size 16 --spp 64 --alpha 0.4,0.2 --metal silver --environment white --quiet ";
  REQUIRE(folder.run("render ball -o exact.exr" + options).status == 0);
  const double exact = mean(folder / "exact.exr");
  for (const std::string surface : {"ggx.h5", "ggx.vndf"})
    for (const std::string sampling : {"previous", "walter", "visible"}) {
      REQUIRE(folder
                  .run("render ball -o a.exr --surface " + surface + " --sampling " + sampling +
                       " --light none" + options)
                  .status == 0);
      CHECK(mean(folder / "a.exr") == vndf::test::Approx(exact).epsilon(0.05));
    }
}

TEST_CASE("a time may be given in place of a number of samples") {
  const Folder folder;
  const Result r = folder.run("render plate -o a.exr --size 8 --seconds 0.2");
  CHECK(r.status == 0);
  CHECK_THAT(r.out, contains("samples each, 0."));
}

TEST_CASE("surroundings come from a file, and their exposure is for the picture only") {
  const Folder folder;
  REQUIRE(folder.run("render ball -o sky.exr --size 16x8 --spp 1 --quiet").status == 0);
  CHECK(folder.run("render plate -o a.png --environment sky.exr --exposure 2" + kTiny).status == 0);
  CHECK(folder.run("render plate -o b.png --environment white" + kTiny).status == 0);
  check_refused(folder, "plate -o c.exr --exposure 2" + kTiny, 2, "is for .png pictures");
}

TEST_CASE("a scene, surface or metal that is not known is refused with the nearest known one") {
  const Folder folder;
  check_refused(folder, "bal -o a.png", 1,
                "'bal' is neither a scene nor an .obj file; did you mean 'ball'?");
  check_refused(folder, "ball -o a.png --surface ggx-cap", 1, "did you mean 'ggx-caps'?");
  check_refused(folder, "ball -o a.png --metal gild", 2, "did you mean 'gold'?");
  check_refused(folder, "ball -o a.png --metal 1.5,-1", 2, "two numbers ETA,K");
}

TEST_CASE("numbers out of range are refused before anything is read") {
  const Folder folder;
  check_refused(folder, "ball -o a.png --spp 0", 2, "'0' is not a whole number from 1");
  check_refused(folder, "ball -o a.png --size 0", 2, "'0' is not a whole number from 1");
  check_refused(folder, "ball -o a.png --size 8x", 2, "'' is not a whole number from 1");
  check_refused(folder, "ball -o a.png --size 99999", 2, "to 16384");
  check_refused(folder, "ball -o a.png --alpha 0", 2, "'0' is not a number from 0.0001 to 10");
  check_refused(folder, "ball -o a.png --glass 0", 2, "'0' is not a number from 0.1 to 10");
  check_refused(folder, "ball -o a.png --seconds 0", 2, "'0' is not a number from 0.001");
  check_refused(folder, "ball -o a.png --exposure nan", 2, "'nan' is not a number from 1e-06");
  check_refused(folder, "ball -o a.png --seconds 1 --spp 3", 2, "excludes");
  check_refused(folder, "ball -o a.png --glass 1.5 --metal gold", 2, "excludes");
  check_refused(folder, "ball -o a.jpg", 2, "ends neither in .exr nor in .png");
}

TEST_CASE("files that are missing or broken are refused in words, and nothing is written") {
  const Folder folder;
  write(folder / "broken.obj", "v 1 2\n");
  write(folder / "broken.exr", "no image");
  write(folder / "broken.vndf", "no tables");
  write(folder / "mine.png", "a photograph");
  check_refused(folder, "none.obj -o a.png", 1, "none.obj");
  check_refused(folder, "broken.obj -o a.png", 1, "broken.obj: line 1");
  check_refused(folder, "ball -o a.png --environment none.exr", 1, "none.exr");
  check_refused(folder, "ball -o a.png --environment broken.exr", 1, "broken.exr");
  check_refused(folder, "ball -o a.png --surface none.vndf", 1, "none.vndf");
  check_refused(folder, "ball -o a.png --surface broken.vndf", 1, "broken.vndf");
  check_refused(folder, "ball -o none/a.png", 1, "the folder 'none' does not exist");
  check_refused(folder, "ball -o mine.png" + kTiny, 1, "vndf did not write it");
  CHECK(content(folder / "mine.png") == "a photograph");
  CHECK(folder.run("render ball -o mine.png --force" + kTiny).status == 0);
}
