// Progress of long commands: a line on a terminal that is gone at the end, and nothing elsewhere.
// `script` of util-linux runs a command on a terminal of its own and writes what appears there.
#include <cstdlib>
#include <utility>

#include "support/catch.h"
#include "support/program_folder.h"

using namespace vndf::test;

namespace {

/// Whether `script` can make a terminal: some containers have no devices for it.
bool has_terminals() {
  return std::system("script -qec true /dev/null >/dev/null 2>&1 </dev/null") == 0;
}

/// What appears on the terminal on which the program runs with `arguments`.
std::string shown_by(const Folder& folder, const std::string& arguments) {
  const std::string command = "cd " + (folder / "").string() +
                              " && script -qec '" VNDF_PROGRAM " " + arguments +
                              "' terminal >/dev/null </dev/null";
  REQUIRE(std::system(command.c_str()) == 0);
  return content(folder / "terminal");
}

}  // namespace

TEST_CASE("long commands show their steps on a terminal and erase them") {
  if (!has_terminals()) {
    WARN("not tested: no terminal can be made here");
    return;
  }
  const Folder folder;
  REQUIRE(folder.run("build ggx -o ggx.h5 --size 64 --quiet").status == 0);
  const std::vector<std::pair<std::string, std::string>> commands{
      {"build beckmann -o a.h5 --size 64", "building"},
      {"bake ggx.h5 -o ggx.vndf --tolerance 1e-3", "baking"},
      {"experiment variance --tables ggx.h5 --samples 1e6", "sampling: "},
      {"validate ggx-caps --quick", "ggx-caps: distribution ["},
      {"bench --quick --only caps", "round 1 of"}};
  for (const auto& [arguments, step] : commands) {
    CAPTURE(arguments);
    const std::string shown = shown_by(folder, arguments);
    const std::size_t begun = shown.find(step), erased = shown.rfind("\r\x1b[K");
    REQUIRE(begun != std::string::npos);
    REQUIRE(erased != std::string::npos);
    CHECK(shown.find(step, erased) == std::string::npos);
  }
}

TEST_CASE("--quiet shows no progress, and neither does a file") {
  const Folder folder;
  if (has_terminals())
    CHECK(shown_by(folder, "build ggx -o a.h5 --size 64 --quiet").find('\x1b') ==
          std::string::npos);
  CHECK(folder.run("build ggx -o a.h5 --size 64").error.empty());
}
