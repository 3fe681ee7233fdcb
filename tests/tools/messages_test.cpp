// What the program says on standard error, whatever the words on the command line are.
#include <algorithm>
#include <string>

#include "support/catch.h"
#include "support/program_folder.h"

using vndf::test::contains;
using vndf::test::Folder;
using vndf::test::Result;

TEST_CASE("an unknown command, experiment or option is named with the one that was meant") {
  const Folder folder;
  const auto says = [&](const std::string& arguments, const std::string& message) {
    CAPTURE(arguments);
    const Result r = folder.run(arguments);
    CHECK(r.status == 2);
    CHECK(r.out.empty());
    CHECK_THAT(r.error, contains(message));
  };
  says("biuld ggx", "no command 'biuld'; did you mean 'build'?");
  says("qqqqqqqqqqqq", "known: build, bake, export, info");
  says("experiment varianc", "no command 'varianc'; did you mean 'variance'?");
  says("build ggx --siez=3", "no option '--siez'; did you mean '--size'?");
  says("info a.h5 b.h5", "'b.h5' is one argument too many");
}

TEST_CASE("no message sends control characters of the command line to the terminal") {
  const Folder folder;
  for (const std::string arguments :
       {"info \"$(printf 'a\\033]0;x\\007b')\"", "\"$(printf 'a\\033b')\"",
        "build ggx -o \"$(printf 'a\\033b')\".txt",
        "build ggx -o a.h5 --size \"$(printf '\\033')\"",
        "check \"$(printf 'a\\033b')\" --against ggx"}) {
    CAPTURE(arguments);
    const Result r = folder.run(arguments);
    CHECK(r.status != 0);
    CHECK(!r.error.empty());
    CHECK(std::ranges::none_of(r.error, [](char c) { return c == '\033' || c == '\007'; }));
  }
}

TEST_CASE("a message about an endless name has an end") {
  const Folder folder;
  CHECK(folder.run("info " + std::string(20000, 'a')).error.size() < 1100);
}

TEST_CASE("--quiet keeps warnings") {
  const Folder folder;
  const Result r = folder.run("build ggx -o a.h5 --size 8 --quiet");
  CHECK(r.status == 0);
  CHECK(r.out.empty());
  CHECK_THAT(r.error, contains("vndf: warning: the marginal table errs by"));
}
