// What a person meets in vndf validate --report: the page, its data, and what it replaces and
// refuses.
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "support/catch.h"
#include "support/program_folder.h"

using namespace vndf::test;

namespace {

/// What stands in `text` between every `before` and the next `after`.
std::vector<std::string> all_between(const std::string& text, const std::string& before,
                                     const std::string& after) {
  std::vector<std::string> list;
  for (std::size_t at = 0; (at = text.find(before, at)) != std::string::npos;) {
    at += before.size();
    list.push_back(text.substr(at, text.find(after, at) - at));
  }
  return list;
}

std::size_t count_of(const std::string& text, const std::string& what) {
  return all_between(text, what, "").size();
}

std::set<std::string> names_in(const std::filesystem::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    names.insert(entry.path().filename());
  return names;
}

/// Columns and rows of an EXR file.
std::pair<int, int> size_of(const std::filesystem::path& path) {
  const Imf::InputFile file(path.c_str(), 0);
  const auto& window = file.header().dataWindow();
  return {window.max.x - window.min.x + 1, window.max.y - window.min.y + 1};
}

/// The environment without any program on its path, until the end of the scope.
class EmptyPath {
 public:
  EmptyPath() : before_(getenv("PATH")) { setenv("PATH", "/nowhere", 1); }
  ~EmptyPath() { setenv("PATH", before_.c_str(), 1); }
  EmptyPath(const EmptyPath&) = delete;
  EmptyPath& operator=(const EmptyPath&) = delete;

 private:
  std::string before_;
};

}  // namespace

TEST_CASE("validate --report writes a page that needs no other file, with its data beside it") {
  const FolderWithTables folder;
  std::filesystem::rename(folder / "ggx.h5", folder / "a&b.h5");
  const Result r = folder.run(
      "validate 'a&b.h5' './a&b.h5' ggx-caps --quick --seed 7 --json v.json --report "
      "out/page");
  CHECK(r.status == 0);
  CHECK(r.error.empty());
  const auto place = folder / "out/page";
  const std::string page = content(place / "index.html");

  // all inside: pictures as data, of which caps have no map; no script, no address
  const auto sources = all_between(page, "src=\"", "\"");
  CHECK(sources.size() == 3 * 4 - 1);
  for (const std::string& source : sources)
    CHECK(source.substr(0, 33) == "data:image/png;base64,iVBORw0KGgo");  // PNG's first bytes
  for (const char* outside : {"http", "<script", "<link", "url(", "@import"})
    CHECK(count_of(page, outside) == 0);

  // each verdict with all of its results
  const auto json = nlohmann::json::parse(content(folder / "v.json"));
  std::size_t results = 0;
  for (const auto& sampler : json.at("samplers")) results += sampler.at("results").size();
  CHECK(count_of(page, "class=\"place\"") == results);
  CHECK_THAT(page, contains("seed 7") && contains("a&amp;b.h5") && !contains("a&b.h5"));

  // the files that it links to are the files that are there
  std::set<std::string> linked{"index.html", "vndf-files.txt"};
  for (const std::string& link : all_between(page, "href=\"", "\""))
    if (link.front() != '#') linked.insert(link);
  CHECK(linked.size() == 2 + sources.size());
  CHECK(names_in(place) == linked);
  CHECK(names_in(folder / "out") == std::set<std::string>{"page"});
  for (const char* name : {"a-b-density.exr", "a-b-2-density.exr", "ggx-caps-density.exr"})
    CHECK(linked.count(name) == 1);
  CHECK(size_of(place / "a-b-density.exr") == std::pair(81, 81));
  CHECK(size_of(place / "a-b-u-error.exr") == std::pair(201, 121));
  CHECK(size_of(place / "a-b-weights.exr") == std::pair(160, 160));
  CHECK(size_of(place / "a-b-curves.exr") == std::pair(180, 1));
}

TEST_CASE("on a narrow screen every row of the report's tables is a block of lines") {
  const Folder folder;
  REQUIRE(folder.run("validate ggx-caps --quick --seed 7 --json v.json --report page").status == 0);
  const std::string page = content(folder / "page/index.html");
  CHECK_THAT(page, contains("<meta name=\"viewport\" content=\"width=device-width"));

  // The rule for narrow screens, and the classes that it places, on all the rows there are.
  const auto rules = all_between(page, "@media (max-width: 720px) {", "</style>");
  REQUIRE(rules.size() == 1);
  for (const char* rule : {"tr { display: grid;", "tr.heads { display: none; }", "td.measured {",
                           "td.place, td.wide {"})
    CHECK_THAT(rules.front(), contains(rule));
  const auto json = nlohmann::json::parse(content(folder / "v.json"));
  const std::size_t results = json.at("samplers").at(0).at("results").size();
  CHECK(count_of(page, "<tr class=\"heads\">") == count_of(page, "<table>"));
  CHECK(count_of(page, "class=\"number measured\"") == results);
  CHECK(count_of(page, "class=\"place\"") == results);
  CHECK(count_of(page, "class=\"wide\"") == 3);
  // Pictures are as wide as the page, whatever their pixels.
  CHECK_THAT(page, contains("img { width: 100%; height: auto;"));
}

TEST_CASE("a report of a failure says so, the status is still 1, and the next one replaces it") {
  const Folder folder;
  CHECK(folder.run("validate ggx-analytic --quick --seed 7 --report page").status == 1);
  CHECK_THAT(content(folder / "page/index.html"),
             contains("1 checked, 1 failed") && contains("inverse: u-error of slope y"));
  CHECK(folder.run("validate ggx-ndf --quick --seed 7 --report page").status == 0);
  CHECK(names_in(folder / "page") ==
        std::set<std::string>{"ggx-ndf-curves.exr", "ggx-ndf-density.exr", "ggx-ndf-weights.exr",
                              "index.html", "vndf-files.txt"});
}

TEST_CASE("a report is refused before any work where it cannot be") {
  const Folder folder;
  std::ofstream(folder / "file") << "text";
  const Result file = folder.run("validate ggx-caps --quick --report file");
  CHECK(file.status == 1);
  CHECK(file.out.empty());
  CHECK_THAT(file.error, contains("it is a file; give the name of a folder"));

  const EmptyPath without_gnuplot;
  const Result missing = folder.run("validate ggx-caps --quick --report page");
  CHECK(missing.status == 1);
  CHECK(missing.out.empty());
  CHECK_THAT(missing.error, contains("gnuplot, which is not installed; install it"));
  CHECK(folder.files() == std::vector<std::string>{"file"});
}

TEST_CASE("a distribution with a pole can be drawn", "[.slow]") {
  const Folder folder;
  REQUIRE(folder.run("build k:nu=0.8 -o k.h5 --size 32x48 --quiet").status == 0);
  CHECK(folder.run("validate k.h5 --quick --seed 7 --report page").error.empty());
  CHECK(names_in(folder / "page").count("k-curves.exr") == 1);
}
