// Which existing files the program replaces, and that it says so before any work.
#include <fstream>
#include <string>

#include "support/catch.h"
#include "support/program_folder.h"

using vndf::test::contains;
using vndf::test::content;
using vndf::test::Folder;
using vndf::test::FolderWithTables;
using vndf::test::Result;

namespace {

void write(const Folder& folder, const std::string& name, const std::string& bytes) {
  std::ofstream(folder / name, std::ios::binary) << bytes;
}

}  // namespace

TEST_CASE("a file that vndf did not write is not replaced, whatever the command") {
  const FolderWithTables folder;
  // Thousands of seconds of work, were it begun.
  const std::string build = "build 'mixture:0.5*ggx+0.5*beckmann@0.01' --size 8192 -o ";
  const auto keeps = [&](const std::string& command, const std::string& name) {
    for (const std::string& precious : {std::string("precious"), std::string(20000, 'x')}) {
      CAPTURE(command + name);
      write(folder, name, precious);
      const Result r = folder.run(command + name);
      CHECK(r.status != 0);
      CHECK(r.out.empty());
      CHECK_THAT(r.error,
                 contains(name + ": it exists and vndf did not write it") && contains("--force"));
      CHECK(content(folder / name) == precious);
    }
  };
  keeps(build, "a.h5");
  keeps(build, "a.vndf");
  keeps("bake ggx.h5 -o ", "a.vndf");
  keeps("export ggx.h5 --as header -o ", "a.h");
  keeps("convert ggx.h5 ", "a.exr");
  keeps("picture ggx.h5 -o ", "a.png");
  keeps("bench --json ", "a.json");
  keeps("bench --plot ", "a.svg");
  keeps("validate ggx.h5 --thorough --json ", "a.json");
  keeps("check none.csv --against ggx --json ", "a.json");
}

TEST_CASE("--force replaces it, and an empty file may always be replaced") {
  const Folder folder;
  write(folder, "a.h5", "precious");
  CHECK(folder.run("build ggx -o a.h5 --size 16 --force").status == 0);
  CHECK(folder.run("info a.h5").status == 0);
  write(folder, "b.h5", "");
  CHECK(folder.run("build ggx -o b.h5 --size 16").status == 0);
}

TEST_CASE("what vndf wrote it replaces") {
  const FolderWithTables folder;
  for (const std::string command :
       {"build ggx -o a.h5 --size 32", "build ggx -o a.exr --size 32",
        "build ggx -o a.vndf --size 64 --tolerance 1e-3", "export a.vndf -o a.h --as header",
        "export a.vndf -o a.csv --vectors 5", "convert ggx.h5 b.exr", "picture ggx.h5 -o a.png",
        "picture ggx.h5 -o a.svg",
        "bench --quick --repetitions 1 --distribution ggx --only hemisphere --json speed.json "
        "--plot speed.svg",
        "validate ggx-caps --quick --seed 1 --json v.json"}) {
    CAPTURE(command);
    CHECK(folder.run(command).status == 0);
    CHECK(folder.run(command).status == 0);
  }
}

TEST_CASE("no command writes over its input") {
  const FolderWithTables folder;
  CHECK_THAT(folder.run("convert ggx.h5 ggx.h5").error, contains("also read"));
  CHECK(folder.run("convert ggx.h5 ggx.h5 --force").status == 1);
}
