// The check of pages finds what it is there to find: each broken page below is rejected.
#include "documentation/check_page.h"

#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "documentation/expected_output.h"
#include "support/catch.h"

namespace vndf::documentation {
namespace {

namespace fs = std::filesystem;

/// A small repository with one file, and room for the commands.
class Place {
 public:
  Place() : top_(fs::temp_directory_path() / ("vndf-pages-" + std::to_string(getpid()))) {
    fs::remove_all(top_);
    fs::create_directories(top_ / "scratch");
    std::ofstream(top_ / "program.cpp") << "int main() {\n  return 0;\n}\n";
  }
  ~Place() { fs::remove_all(top_); }
  Place(const Place&) = delete;
  Place& operator=(const Place&) = delete;

  std::vector<std::string> problems(const std::string& page) const {
    return problems_of(page, top_, {top_, top_ / "scratch", "/bin/sh"});
  }

 private:
  fs::path top_;
};

void check_accepted(const std::string& page) {
  const auto problems = Place().problems(page);
  INFO((problems.empty() ? "" : problems.front()));
  CHECK(problems.empty());
}

void check_rejected(const std::string& page, const std::string& why) {
  const auto problems = Place().problems(page);
  REQUIRE(problems.size() == 1);
  CHECK_THAT(problems.front(), test::contains(why));
}

TEST_CASE("A page whose commands print what it says is accepted", "[documentation]") {
  check_accepted("```console\n$ echo one   two\none two\n$ echo 3; echo 4\n...\n4\n```\n");
  check_accepted("```sh\n# The second line uses what the first one set.\nx=1\ntest $x = 1\n```\n");
  check_accepted("<!-- status 3 -->\n```console\n$ true\n$ (exit 3)\n```\n");
  check_accepted("<!-- file a.csv -->\n```csv\nr,p22\n```\n```console\n$ cat a.csv\nr,p22\n```\n");
}

TEST_CASE("A command that fails or prints something else is a problem", "[documentation]") {
  check_rejected("```sh\nfalse\n```\n", "line 2: false has status 1");
  check_rejected("<!-- status 3 -->\n```console\n$ (exit 2)\n```\n", "status 2");
  check_rejected("```console\n$ echo one\ntwo\n```\n", "does not print\ntwo");
  check_rejected("```console\n$ echo one\n```\n", "nothing more");
  check_rejected("```console\n$ echo 1.01\n1.00\n```\n", "does not print\n1.00");
}

TEST_CASE("A code block is marked, fenced, and a file's own lines", "[documentation]") {
  check_accepted("<!-- from program.cpp -->\n```cpp\n  return 0;\n}\n```\n");
  check_rejected("<!-- from program.cpp -->\n```cpp\n  return 1;\n```\n", "not the lines");
  check_rejected("```cpp\nint main() {\n```\n", "nothing checks");
  check_rejected("Text.\n\n    vndf build\n", "fence it");
  check_accepted("<!-- not run: it takes an hour -->\n```sh\nfalse\n```\n");
}

TEST_CASE("What a page links to exists", "[documentation]") {
  check_accepted("# A Title, here\n[a](program.cpp) [b](#a-title-here) [c](https://example.org)\n");
  check_rejected("[a](other.cpp)\n", "a link to other.cpp");
  check_rejected("# Title\n[a](#another)\n", "a heading that is not there");
}

TEST_CASE("Outputs agree where only spaces, rounding and what is left out differ",
          "[documentation]") {
  CHECK(first_difference("a  1.0000 b\n", "a 1.00005 b\n").empty());
  CHECK(first_difference("1.0\n", "1.1\n", 0.2).empty());
  CHECK(first_difference("wrote (...) in ... s\n", "wrote (2 MiB) in 0.6 s\n").empty());
  CHECK(first_difference("a\n...\nc\n", "a\nb\nb\nc\n").empty());
  CHECK(first_difference("a\n...\n", "a\n").empty());
  CHECK(first_difference("1.0\n", "-1.0\n") == "1.0");
  CHECK(first_difference("a\nb\n", "a\n") == "b");
  CHECK(first_difference("a\n...\nd\n", "a\nb\nc\n") == "d");
}

}  // namespace
}  // namespace vndf::documentation
