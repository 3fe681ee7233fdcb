// The pages of this repository are true. Each is a test of its own, which runs its commands in a
// folder that looks like a clone after both set-up commands: the programs are built, the tables are
// made.
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <vector>

#include "documentation/check_page.h"
#include "documentation/expected_output.h"
#include "documentation/markdown.h"
#include "support/catch.h"
#include "vndf/io/exr_image.h"

namespace vndf::documentation {
namespace {

namespace fs = std::filesystem;

constexpr int kMostLinesOfReadme = 170;

std::string content(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

class Clone {
 public:
  Clone() : top_(fs::temp_directory_path() / ("vndf-clone-" + std::to_string(getpid()))) {
    const fs::path source = VNDF_SOURCE, build = VNDF_BUILD;
    fs::remove_all(top_);
    fs::create_directories(top_ / "build/tables");
    fs::create_directories(top_ / "build/tests");
    fs::create_directories(top_ / "build/tools");
    fs::create_symlink(VNDF_PROGRAM, top_ / "build/tools/vndf");
    for (const std::string name : {"filtered_map", "render", "metal", "microsurface_walk",
                                   "own_distribution", "write_records"}) {
      const std::string example = "build/tests/example_" + name;
      fs::create_symlink(build / "tests" / ("example_" + name), top_ / example);
    }
    fs::create_symlink(build / "python", top_ / "build/python");
    fs::create_symlink(VNDF_PYTHON, top_ / "build/tools/python3");
    fs::create_directories(top_ / "tests/examples");
    fs::create_symlink(source / "tests/examples/python", top_ / "tests/examples/python");
    fs::copy(source / "tables", top_ / "tables", fs::copy_options::recursive);
  }
  ~Clone() {
    fs::remove_all(top_);
    fs::remove_all(streams());
  }
  Clone(const Clone&) = delete;
  Clone& operator=(const Clone&) = delete;

  Surroundings surroundings() const { return {VNDF_SOURCE, top_, top_ / "build/tools/vndf"}; }

  /// What `command` prints, run at the top of the clone.
  std::string output_of(const std::string& command) const {
    const std::string file = (top_ / "output").string();
    const std::string line = "cd '" + top_.string() + "' && PATH=\"$PWD/build/tools:$PATH\" && " +
                             command + " >'" + file + "' 2>&1";
    const int status = std::system(line.c_str());
    INFO(content(file));
    REQUIRE(status == 0);
    return content(file);
  }

  /// A map of slopes without correlation, of roughness 0.3 x 0.1, as a user brings one.
  void make_slope_map(const std::string& name) const {
    constexpr std::size_t kSide = 256;
    std::mt19937 random(1);
    std::normal_distribution<float> normal(0, std::sqrt(0.5f));
    std::vector<float> x(kSide * kSide), y(kSide * kSide);
    for (float& slope : x) slope = 0.3f * normal(random);
    for (float& slope : y) slope = 0.1f * normal(random);
    std::ofstream(top_ / name, std::ios::binary)
        << io::write_exr_image({kSide, kSide, {{"slope_x", x}, {"slope_y", y}}});
  }

  /// Those tables of the target "tables" that a page names.
  void make_tables(const std::string& page) const {
    for (const std::string name : {"ggx", "beckmann"}) {
      const std::string base = "build/tables/" + name;
      if (page.find(base) == std::string::npos) continue;
      output_of("vndf build " + name + " --quiet -o " + base + ".h5");
      output_of("vndf bake --quiet " + base + ".h5 -o " + base + ".vndf");
    }
  }

 private:
  std::string streams() const { return top_.string() + "-streams"; }

  fs::path top_;
};

void check_page(const std::string& name) {
  const fs::path path = fs::path(VNDF_SOURCE) / name;
  const std::string text = content(path);
  REQUIRE(!text.empty());
  const Clone clone;
  clone.make_tables(text);
  if (text.find("bumps.exr") != std::string::npos) clone.make_slope_map("bumps.exr");
  for (const std::string& problem : problems_of(text, path.parent_path(), clone.surroundings()))
    FAIL_CHECK(name << ", " << problem);
}

TEST_CASE("README.md", "[.page]") {
  check_page("README.md");
  CHECK(read_page(content(fs::path(VNDF_SOURCE) / "README.md")).lines <= kMostLinesOfReadme);
}
TEST_CASE("lib/README.md", "[.page]") {
  check_page("lib/README.md");
}
TEST_CASE("lib/python/README.md", "[.page]") {
  check_page("lib/python/README.md");
}
TEST_CASE("tables/README.md", "[.page]") {
  check_page("tables/README.md");
}
TEST_CASE("tables/FORMAT.md", "[.page]") {
  check_page("tables/FORMAT.md");
}
TEST_CASE("tests/README.md", "[.page]") {
  check_page("tests/README.md");
}
TEST_CASE("tests/data/README.md", "[.page]") {
  check_page("tests/data/README.md");
}
TEST_CASE("tools/README.md", "[.page]") {
  check_page("tools/README.md");
}

/// The line of a page's tables that starts as `row` does, up to the end of its first cell.
std::string line_like(const std::string& page, const std::string& row) {
  const std::string first_cell = row.substr(0, row.find('|', 1));
  const auto begin = page.find('\n' + first_cell) + 1;
  return page.substr(begin, page.find('\n', begin) - begin + 1);
}

/// The script makes the row that the page shows. Its errors are of the size of rounding, so another
/// processor may find them a fifth larger or smaller; seconds are not compared.
void check_row(const std::string& table, const std::string& name, const std::string& page) {
  const std::string script = "sh tables/make_accuracy.sh " + table;
  const std::string printed = Clone().output_of(script + ' ' + name);
  const auto row = printed.find("| `" + name + "` |");
  REQUIRE(row != std::string::npos);
  const std::string text = content(fs::path(VNDF_SOURCE) / page);
  const auto shown = text.find(printed.substr(0, row));  // the head of the table
  REQUIRE(shown != std::string::npos);
  const std::string expected = line_like(text.substr(shown), printed.substr(row));
  const auto seconds = [](const std::string& line) {
    return line.substr(0, line.find_last_of('|', line.find_last_of('|') - 1));
  };
  const bool timed = table == "pairs";
  CHECK(first_difference(timed ? seconds(expected) : expected,
                         timed ? seconds(printed.substr(row)) : printed.substr(row), 0.2)
            .empty());
}

TEST_CASE("Tables of accuracy are what their script prints", "[.rows]") {
  check_row("pairs", "ggx", "tables/README.md");
  check_row("baked", "ggx", "tables/README.md");
  check_row("samplers", "ggx-caps", "tests/README.md");
}

}  // namespace
}  // namespace vndf::documentation
