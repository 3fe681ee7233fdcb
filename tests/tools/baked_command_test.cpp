// Baked tables on the command line: made, shown, sampled, copied and validated, or refused
// in words.
#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "support/catch.h"
#include "support/program_folder.h"
#include "vndf/io/table_file.h"
#include "vndf/kernel_tables.h"

namespace fs = std::filesystem;
using vndf::test::contains;
using vndf::test::content;
using vndf::test::Folder;
using vndf::test::Result;

namespace {

/// With a pair of tables, "ggx.h5", and those baked from it, "ggx.vndf".
class FolderWithBakedTables : public Folder {
 public:
  FolderWithBakedTables() {
    REQUIRE(run("build ggx -o ggx.h5 --size 64 --quiet").status == 0);
    REQUIRE(run("bake ggx.h5 -o ggx.vndf --tolerance 1e-3 --quiet").status == 0);
  }
};

void check_refusal(const Result& r, int status, const std::string& message) {
  CHECK(r.status == status);
  CHECK_THAT(r.error, contains(message));
  CHECK(r.out.empty());
}

std::size_t lines_of(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

}  // namespace

TEST_CASE("bake writes tables that are measured against the distribution, and says what it chose") {
  const Folder folder;
  REQUIRE(folder.run("build ggx -o ggx.h5 --size 64 --quiet").status == 0);
  const Result r = folder.run("bake ggx.h5 -o ggx.vndf --tolerance 1e-3");
  CHECK(r.status == 0);
  CHECK(r.error.empty());
  CHECK_THAT(r.out, contains("0.001 of the pair") && contains("columns by") &&
                        contains("sampling reads") &&
                        contains("measured against the exact distribution") &&
                        contains("wrote ggx.vndf"));
  const vndf::KernelTables tables = vndf::load(folder / "ggx.vndf");
  CHECK(tables.header().certified == 1);
  CHECK(tables.header().tolerance == 1e-3);
  CHECK(tables.certificate().marginal.max_u_error > 0);
  CHECK(tables.certificate().marginal.max_u_error < 2e-3);
  CHECK(lines_of(folder.run("bake ggx.h5 -o ggx.vndf --quiet").out) == 0);
}

TEST_CASE("baked tables are the same from a pair or at once, and say how they were made") {
  const FolderWithBakedTables folder;
  REQUIRE(folder.run("build ggx --size 64 --tolerance 1e-3 -o once.vndf --quiet").status == 0);
  const vndf::KernelTables baked = vndf::load(folder / "ggx.vndf");
  const vndf::KernelTables once = vndf::load(folder / "once.vndf");
  CHECK(baked.with_text({}).bytes().size() == once.with_text({}).bytes().size());
  CHECK(std::ranges::equal(baked.with_text({}).bytes(), once.with_text({}).bytes()));
  CHECK(baked.text().provenance.specification == vndf::Specification{"ggx"});
  CHECK(baked.text().provenance.command ==
        "vndf build ggx -o ggx.h5 --size 64\nvndf bake ggx.h5 -o ggx.vndf --tolerance 1e-3");
}

TEST_CASE("baked tables do not depend on the number of threads") {
  const FolderWithBakedTables folder;
  const std::string first = content(folder / "ggx.vndf");
  REQUIRE(folder.run("bake ggx.h5 -o ggx.vndf --tolerance 1e-3 --quiet --threads 3").status == 0);
  CHECK(content(folder / "ggx.vndf") == first);
}

TEST_CASE("build and bake report baked tables as JSON") {
  const FolderWithBakedTables folder;
  const auto built = nlohmann::json::parse(folder.run("build ggx --size 64 -o b.vndf --json").out);
  CHECK(built.at("output") == "b.vndf");
  CHECK(built.at("tolerance") == 1e-5);
  CHECK(built.at("bytes") == fs::file_size(folder / "b.vndf"));
  CHECK(built.at("mass") > 0);
  const auto baked =
      nlohmann::json::parse(folder.run("bake ggx.h5 -o c.vndf --tolerance 1e-4 --json").out);
  CHECK(baked.at("tolerance") == 1e-4);
  CHECK(baked.at("certified") == true);
  CHECK(baked.at("sampling_bytes") < baked.at("bytes"));
  CHECK(baked.at("certificate").size() == 36);
}

TEST_CASE("info shows what baked tables hold, for people and as JSON") {
  const FolderWithBakedTables folder;
  CHECK_THAT(folder.run("info ggx.vndf").out,
             contains("ggx slopes") && contains("vndf build ggx") && contains("vndf bake ggx.h5") &&
                 contains("baked within") && contains("columns by") && contains("slope y") &&
                 contains("u-error, max"));
  const auto json = nlohmann::json::parse(folder.run("info ggx.vndf --json").out);
  for (const char* key : {"distribution", "specification", "command", "program", "tolerance",
                          "difference_x", "difference_y", "columns", "separable", "unit",
                          "sampling_bytes", "bytes", "certified", "certificate"})
    CHECK(json.contains(key));
}

TEST_CASE("baked tables are sampled nearly as their pair, in single precision only") {
  const FolderWithBakedTables folder;
  const std::string options = " --wi 0.6,0,0.8 --alpha 0.5 -n 20 --seed 4";
  const Result baked = folder.run("sample ggx.vndf" + options);
  CHECK(lines_of(baked.out) == 21);
  CHECK_THAT(baked.out, contains("u1,u2,slope_x,slope_y,mx,my,mz,pdf"));
  const Result pair = folder.run("sample ggx.h5" + options);
  const auto last = [](const std::string& out) {
    return std::stod(out.substr(out.rfind(',') + 1));
  };
  CHECK(last(baked.out) == vndf::test::Approx(last(pair.out)).epsilon(0.02));
  CHECK(lines_of(folder.run("sample ggx.vndf --stdin", "0.6 0 0.8 1 1 0.25 0.75\n").out) == 1);
  check_refusal(folder.run("sample ggx.vndf --double" + options), 1,
                "ggx.vndf: baked tables are sampled in single precision only");
}

TEST_CASE("convert copies baked tables and makes neither kind of the other") {
  const FolderWithBakedTables folder;
  REQUIRE(folder.run("convert ggx.vndf copy.vndf").status == 0);
  CHECK(content(folder / "copy.vndf") == content(folder / "ggx.vndf"));
  check_refusal(folder.run("convert ggx.h5 a.vndf"), 1, "vndf bake ggx.h5 -o a.vndf");
  check_refusal(folder.run("convert ggx.vndf a.h5"), 1,
                "ggx.vndf: baked tables do not hold the pair");
  CHECK_FALSE(fs::exists(folder / "a.vndf"));
  CHECK_FALSE(fs::exists(folder / "a.h5"));
}

TEST_CASE("what needs the pair says so of baked tables") {
  const FolderWithBakedTables folder;
  for (const std::string command : {"bake ggx.vndf -o a.vndf", "picture ggx.vndf -o a.png",
                                    "experiment variance --tables ggx.vndf"}) {
    CAPTURE(command);
    check_refusal(folder.run(command), 1,
                  "ggx.vndf: it holds baked tables and not the pair that they are baked from");
  }
}

TEST_CASE("options of baking are refused where a pair is written, and out of their range") {
  const FolderWithBakedTables folder;
  check_refusal(folder.run("build ggx -o a.h5 --tolerance 1e-4"), 2, "--tolerance: is for baked");
  check_refusal(folder.run("build ggx -o a.exr --max-bytes 5000"), 2, "--max-bytes: is for baked");
  check_refusal(folder.run("bake ggx.h5 -o a.vndf --tolerance 0.5"), 2, "'0.5'");
  check_refusal(folder.run("bake ggx.h5 -o a.vndf --tolerance 1e-9"), 2, "'1e-9'");
  check_refusal(folder.run("bake ggx.h5 -o a.vndf --max-bytes 1.5"), 2, "'1.5'");
  check_refusal(folder.run("bake ggx.h5 -o a.h5"), 1, "a.h5: baked tables are written to a .vndf");
  check_refusal(folder.run("bake ggx.h5"), 2, "--output");
  check_refusal(folder.run("bake missing.h5 -o a.vndf"), 1, "missing.h5");
  check_refusal(folder.run("bake ggx.h5 -o none/a.vndf"), 1, "none/a.vndf");
  CHECK(folder.files().size() == 2);
}

TEST_CASE("tables that do not fit the bytes are not written") {
  const FolderWithBakedTables folder;
  const Result r = folder.run("bake ggx.h5 -o a.vndf --max-bytes 64");
  CHECK(r.status == 1);
  CHECK(lines_of(r.error) == 1);
  CHECK_FALSE(fs::exists(folder / "a.vndf"));
}

TEST_CASE("where the distribution is not specified the certificate follows from the pair's") {
  const FolderWithBakedTables folder;
  vndf::io::TableFile pair = vndf::io::load(folder / "ggx.h5");
  pair.provenance.specification = {};
  vndf::io::save(folder / "own.h5", pair);
  const Result r = folder.run("bake own.h5 -o own.vndf --tolerance 1e-3");
  CHECK(r.status == 0);
  CHECK_THAT(r.error, contains("warning: certificate: that of the pair") &&
                          contains("own.h5: its distribution cannot be made again"));
  CHECK_THAT(r.out, contains("not measured"));
  check_refusal(folder.run("validate own.h5 --quick"), 1,
                "own.h5: its distribution cannot be made again: the specification of the "
                "distribution is empty");
  const vndf::KernelTables tables = vndf::load(folder / "own.vndf");
  CHECK(tables.header().certified == 0);
  CHECK(tables.certificate().marginal.max_u_error >= pair.certificate.marginal.max_u_error);
}

TEST_CASE("a damaged file of baked tables is refused by name") {
  const FolderWithBakedTables folder;
  const std::string whole = content(folder / "ggx.vndf");
  const auto refused = [&](const std::string& bytes, const std::string& why) {
    std::ofstream(folder / "bad.vndf", std::ios::binary) << bytes;
    check_refusal(folder.run("info bad.vndf"), 1, "bad.vndf: " + why);
  };
  refused(whole.substr(0, whole.size() / 2), "the bytes are fewer or more");
  refused("", "shorter than the header");
  refused("not a table at all, but long enough to be looked at" + std::string(1000, '.'),
          "not a file of baked tables");
  std::string changed = whole;
  changed[whole.size() / 2] ^= 1;
  refused(changed, "the checksum does not match");
}

TEST_CASE("validate and check take baked tables") {
  const FolderWithBakedTables folder;
  const Result r = folder.run("validate ggx.vndf --quick --seed 1");
  CAPTURE(r.out, r.error);
  CHECK(r.status == 0);
  CHECK_THAT(r.out, contains("ggx.vndf: pass"));
  CHECK_THAT(folder.run("check missing.csv --against ggx.vndf").error, contains("missing.csv"));
}

TEST_CASE("bench times the samplers of files of either kind, and nothing that was not asked for") {
  const FolderWithBakedTables folder;
  REQUIRE(folder.run("bench ggx.h5 ggx.vndf --quick --repetitions 1 --json speed.json").status ==
          0);
  const auto report = nlohmann::json::parse(content(folder / "speed.json"));
  std::vector<std::string> names;
  for (const auto& entry : report.at("entries")) names.push_back(entry.at("name"));
  CHECK(names == std::vector<std::string>{"ggx caps as published", "ggx.h5 linear",
                                          "ggx.vndf kernel", "ggx.vndf kernel, prepared",
                                          "ggx.vndf kernel, batched",
                                          "ggx.vndf kernel, on surfaces"});
  CHECK(report.at("entries")[2].at("kind") == "kernel");
  check_refusal(folder.run("bench none.vndf --quick"), 1, "none.vndf");
  check_refusal(folder.run("bench --device cuda"), 2, "give .vndf files");
  check_refusal(folder.run("bench ggx.vndf --device cuda --only caps"), 2, "--only excludes");
  check_refusal(folder.run("bench ggx.h5 --device cuda"), 1, "ggx.h5");
}
