// What a person meets in vndf experiment scenes: the folder that it makes, and what it refuses.
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "support/catch.h"
#include "support/program_folder.h"

using namespace vndf::test;

namespace {

std::set<std::string> names_in(const std::filesystem::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    names.insert(entry.path().filename());
  return names;
}

}  // namespace

TEST_CASE("experiment scenes makes a page, the data of its pictures, and the numbers") {
  const Folder folder;
  const Result r = folder.run("experiment scenes out/page --size 16 --spp 2 --reference-spp 8");
  CHECK(r.error.empty());
  REQUIRE(r.status == 0);
  CHECK_THAT(r.out, contains("Figure 1") && contains("wrote out/page/index.html"));
  const auto place = folder / "out/page";
  const auto json = nlohmann::json::parse(content(place / "numbers.json"));
  const std::string page = content(place / "index.html");

  // every file of the numbers is there, is linked, and there is no other
  std::set<std::string> expected{"index.html", "numbers.json", "vndf-files.txt"};
  for (const auto& figure : json.at("figures")) {
    expected.insert(figure.at("reference").at("file"));
    for (const char* comparison : {"equal_samples", "equal_time"})
      for (const auto& rendering : figure.at(comparison)) expected.insert(rendering.at("file"));
  }
  CHECK(expected.size() == 3 + 4 * 8);
  CHECK(names_in(place) == expected);
  for (const std::string& name : expected)
    if (name.ends_with(".exr")) CHECK_THAT(page, contains("href=\"" + name + "\""));
  CHECK_THAT(page, contains("href=\"numbers.json\""));

  // the same samples at equal samples, though fewer pixels have more of them
  const auto& figures = json.at("figures");
  for (std::size_t k = 0; k < 4; ++k) {
    INFO(figures[k].at("name"));
    const bool smaller = figures[k].at("name") == "plate-beckmann";
    CHECK(figures[k].at("width") == (smaller ? 8 : 16));
    for (const auto& rendering : figures[k].at("equal_samples"))
      CHECK(rendering.at("samples") == (smaller ? 8 : 2));
    CHECK(figures[k].at("reference").at("samples") == (smaller ? 32 : 8));
  }
}

TEST_CASE("the same seed makes the same pictures at equal samples, whatever the threads") {
  const Folder folder;
  const std::string command = "experiment scenes page --size 16 --spp 1 --reference-spp 4 ";
  const auto picture = [&] { return content(folder / "page/plate-previous.exr"); };
  REQUIRE(folder.run(command + "--seed 5 --threads 1").status == 0);
  const std::string first = picture();
  REQUIRE(folder.run(command + "--seed 5 --threads 3").status == 0);
  CHECK(picture() == first);
  REQUIRE(folder.run(command + "--seed 6").status == 0);
  CHECK(picture() != first);
}

TEST_CASE("the plate is less noisy by visible normals, and the same by tables as analytically") {
  const Folder folder;
  REQUIRE(
      folder.run("experiment scenes page --size 48 --spp 16 --reference-spp 256 --seed 3").status ==
      0);
  const auto json = nlohmann::json::parse(content(folder / "page/numbers.json"));
  const auto& plate = json.at("figures").at(0);
  REQUIRE(plate.at("name") == "plate");
  const auto& renderings = plate.at("equal_samples");
  const auto error = [&](std::size_t k) {
    return renderings.at(k).at("relative_mse").get<double>();
  };
  // Of other seeds, the previous method has 6 to 37 times the error of visible normals.
  CHECK(renderings.at(0).at("sampling") == "previous");
  CHECK(error(0) > 3 * error(2));
  // Over other seeds this ratio spreads by 8 %.
  CHECK(renderings.at(3).at("sampling") == "analytic");
  CHECK(error(2) == Approx(error(3)).epsilon(0.3));
  CHECK(plate.at("reference").at("relative_mse") < error(2) / 5);
}

TEST_CASE("experiment scenes refuses what it cannot do before any work, and writes nothing") {
  const Folder folder;
  for (const char* option :
       {"--spp 0", "--reference-spp 1", "--size 15", "--size x", "--seed -1"}) {
    INFO(option);
    const Result r = folder.run(std::string("experiment scenes page ") + option);
    CHECK(r.status == 2);
    CHECK_THAT(r.error, contains("is not a whole number"));
  }
  CHECK(folder.run("experiment scenes").status == 2);
  CHECK(folder.files().empty());

  std::filesystem::create_directories(folder / "mine");
  std::ofstream(folder / "mine/letter.txt") << "text";
  const Result mine = folder.run("experiment scenes mine");
  CHECK(mine.status == 1);
  CHECK(mine.out.empty());
  CHECK_THAT(mine.error, contains("mine"));
  CHECK(names_in(folder / "mine") == std::set<std::string>{"letter.txt"});
  CHECK(folder.files() == std::vector<std::string>{"mine"});
}
