// Folders that appear whole or not at all, and what they replace.
#include "vndf/io/atomic_folder.h"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

#include "support/catch.h"
#include "vndf/io/format_error.h"

using namespace vndf::io;
using namespace vndf::test;
namespace fs = std::filesystem;

namespace {

using Names = std::set<std::string>;

/// A folder of the test's own, gone after it.
class Place {
 public:
  Place() : path_(fs::temp_directory_path() / ("vndf-folder-test-" + std::to_string(getpid()))) {
    fs::remove_all(path_);
    fs::create_directories(path_);
  }
  ~Place() { fs::remove_all(path_); }
  Place(const Place&) = delete;
  Place& operator=(const Place&) = delete;

  fs::path operator/(const std::string& name) const { return path_ / name; }
  Names names(const std::string& folder = ".") const {
    Names found;
    for (const auto& entry : fs::directory_iterator(path_ / folder))
      found.insert(entry.path().filename());
    return found;
  }

 private:
  fs::path path_;
};

void write_folder(const fs::path& path, const Names& names) {
  AtomicFolder folder(path);
  for (const std::string& name : names) folder.write(name, name + " of " + path.string());
  folder.put_in_place();
}

std::string content(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

TEST_CASE("a folder appears with its files and their list, and nothing beside it") {
  const Place place;
  write_folder(place / "a/b", {"x", "y"});
  CHECK(place.names("a") == Names{"b"});
  CHECK(place.names("a/b") == Names{"x", "y", AtomicFolder::kList});
  CHECK(content(place / "a/b/x") == "x of " + (place / "a/b").string());
}

TEST_CASE("a folder that is not put in place leaves nothing behind") {
  const Place place;
  {
    AtomicFolder folder(place / "a");
    folder.write("x", "text");
    CHECK(!fs::exists(place / "a"));
  }
  CHECK(place.names().empty());
}

TEST_CASE("a folder replaces an empty one and an earlier one with all of its files") {
  const Place place;
  fs::create_directory(place / "a");
  write_folder(place / "a", {"x", "y"});
  write_folder(place / "a/", {"z"});
  CHECK(place.names() == Names{"a"});
  CHECK(place.names("a") == Names{"z", AtomicFolder::kList});
}

TEST_CASE("a folder that holds a file of someone else is refused and stays as it was") {
  const Place place;
  write_folder(place / "a", {"x"});
  std::ofstream(place / "a/notes") << "mine";
  CHECK_THROWS_WITH(AtomicFolder(place / "a"),
                    contains("it holds 'notes'") && contains("move it away"));
  CHECK(place.names("a") == Names{"x", "notes", AtomicFolder::kList});
  CHECK(place.names() == Names{"a"});
}

TEST_CASE("a file of someone else that comes in the meantime is not lost") {
  const Place place;
  write_folder(place / "a", {"x"});
  {
    AtomicFolder folder(place / "a");
    folder.write("y", "text");
    std::ofstream(place / "a/notes") << "mine";
    CHECK_THROWS_AS(folder.put_in_place(), FormatError);
  }
  CHECK(place.names("a") == Names{"x", "notes", AtomicFolder::kList});
  CHECK(place.names() == Names{"a"});
}

TEST_CASE("a folder inside is someone else's, even under a listed name") {
  const Place place;
  write_folder(place / "a", {"x"});
  fs::remove(place / "a/x");
  fs::create_directory(place / "a/x");
  CHECK_THROWS_AS(AtomicFolder(place / "a"), FormatError);
}

TEST_CASE("a list that names files outside of its folder removes none of them") {
  const Place place;
  std::ofstream(place / "precious") << "mine";
  write_folder(place / "a", {"x"});
  std::ofstream(place / ("a/" + std::string(AtomicFolder::kList)), std::ios::app)
      << "../precious\n"
      << (place / "precious").string() << '\n';
  write_folder(place / "a", {"y"});
  CHECK(content(place / "precious") == "mine");
}

TEST_CASE("a file in the way is refused") {
  const Place place;
  std::ofstream(place / "a") << "text";
  CHECK_THROWS_WITH(AtomicFolder(place / "a"), contains("it is a file; give the name of a folder"));
  CHECK_THROWS_WITH(AtomicFolder(place / "a/b"), contains("it cannot be made"));
}

TEST_CASE("a link to a folder stays a link") {
  const Place place;
  write_folder(place / "a", {"x"});
  fs::create_directory_symlink(place / "a", place / "link");
  write_folder(place / "link", {"y"});
  CHECK(fs::is_symlink(place / "link"));
  CHECK(place.names("a") == Names{"y", AtomicFolder::kList});
}
