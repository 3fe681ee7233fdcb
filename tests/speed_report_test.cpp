// The benchmark from the list of samplers to its report and picture. No time is asserted.
#include "bench/speed_report.h"

#include <cmath>
#include <memory>
#include <set>
#include <stdexcept>

#include "bench/entrants.h"
#include "bench/speed_plot.h"
#include "catch.h"

using namespace vndf;
using namespace vndf::bench;
using vndf::test::Approx;
using vndf::test::contains;

namespace {

/// What --quick does, and quicker.
FieldOptions small_field() {
  return {.distributions = {"ggx"}, .sides = {16}};
}

/// One run for all tests.
const SpeedReport& report() {
  static const SpeedReport made =
      measure_speed(entrants(small_field()),
                    {.collect = {2, 1e-4}, .samples = 1, .program = "vndf test", .progress = {}});
  return made;
}

const SpeedEntry& entry(const std::string& name) {
  for (const SpeedEntry& e : report().entries)
    if (e.name == name) return e;
  throw std::runtime_error("no entry " + name);
}

SpeedEntry made_up(const std::string& distribution, double seconds, std::optional<double> u_error) {
  SpeedEntry e;
  e.name = distribution + " made up";
  e.distribution = distribution;
  e.errors.u = u_error;
  e.coherent.median = 2 * seconds;
  e.incoherent.median = seconds;
  return e;
}

void check_timing(const nlohmann::json& t) {
  CHECK(t.size() == 3);
  CHECK(t.at("lowest") > 0);
  CHECK(t.at("lowest") <= t.at("median"));
  CHECK(t.at("median") <= t.at("highest"));
}

}  // namespace

TEST_CASE("the field holds the baseline first, references and tables") {
  const auto list = entrants(FieldOptions());
  CHECK(list.front().kind == Kind::baseline);
  std::set<std::string> names;
  for (const Entrant& e : list) names.insert(e.name);
  CHECK(names.size() == list.size());
  for (const std::string& d : kUsualDistributions)
    for (const char* what : {" literal 1024", " linear 16"}) CHECK(names.count(d + what) == 1);
  CHECK(names.count("beckmann analytic") == 1);
  CHECK(names.count("ggx caps") == 1);
}

TEST_CASE("an unknown distribution is refused before any work") {
  CHECK_THROWS_WITH(entrants({.distributions = {"gxx"}}), contains("gxx"));
}

TEST_CASE("words choose samplers, and the baseline always runs") {
  const auto few = chosen(entrants(small_field()), {"linear", "hemi"});
  REQUIRE(few.size() == 3);
  CHECK(few[0].kind == Kind::baseline);
  CHECK(few[1].name == "ggx hemisphere");
  CHECK(few[2].name == "ggx linear 16");
  CHECK(chosen(entrants(small_field()), {}).size() == entrants(small_field()).size());
  CHECK_THROWS_WITH(chosen(entrants(small_field()), {"linear", "linnear"}), contains("'linnear'"));
}

TEST_CASE("the errors of tables are the worst figures of the certificate") {
  Certificate c;
  c.marginal.max_u_error = 2e-5;
  c.conditional.max_u_error = 3e-5;
  c.marginal.max_density_error = 0.2;
  c.marginal.upper.e6 = 1.5;
  c.conditional.lower.e6 = 0.5;
  const Errors e = errors_of(c);
  CHECK(e.u == 3e-5);
  CHECK(e.density == 0.2);
  CHECK(e.tail_ratio == 0.5);
}

TEST_CASE("every sampler writes a unit normal for every sample") {
  for (const Entrant& e : entrants(small_field())) {
    const Contestant c = e.make();
    SampleInputs inputs(1);
    const SampleBlock b = inputs.next();
    for (const bool coherent : {false, true}) {
      coherent ? c.coherent(kCoherentWi, kCoherentAlpha, b) : c.incoherent(b);
      for (std::size_t k = 0; k < b.size(); ++k) {
        CAPTURE(e.name, coherent, k);
        REQUIRE(std::abs(std::hypot(b.wm_x[k], b.wm_y[k], b.wm_z[k]) - 1) < 1e-5);
      }
    }
  }
}

TEST_CASE("a run yields every figure of every sampler") {
  REQUIRE(report().entries.size() == entrants(small_field()).size());
  for (const SpeedEntry& e : report().entries) {
    CAPTURE(e.name);
    CHECK(e.coherent.median > 0);
    CHECK(e.incoherent.median > 0);
    CHECK(e.coherent_ratio > 0);
    CHECK(e.incoherent_ratio > 0);
    const bool stored = e.kind == Kind::table;
    const bool measured = stored || e.kind == Kind::literal;
    CHECK(e.setup.has_value() == stored);
    CHECK((e.bytes > 0) == measured);
    CHECK((e.build_seconds > 0) == measured);
    CHECK(e.errors.density.has_value() == measured);
    CHECK(e.errors.tail_ratio.has_value() == measured);
  }
  CHECK(entry("ggx caps as published").coherent_ratio == 1);
  CHECK(entry("ggx caps as published").incoherent_ratio == 1);
  CHECK_FALSE(entry("ggx all normals").errors.u.has_value());
  CHECK(entry("ggx literal 16").bytes == 2 * 16 * 16 * sizeof(float));
}

TEST_CASE("ratios are to the first entry, fronts are per distribution") {
  std::vector<SpeedEntry> list{made_up("a", 10, 1e-3), made_up("a", 20, 1e-5),
                               made_up("a", 30, 1e-4), made_up("b", 50, 1e-2),
                               made_up("a", 1, std::nullopt)};
  compare(list);
  CHECK(list[1].incoherent_ratio == 2);
  CHECK(list[3].coherent_ratio == 5);
  CHECK(list[0].on_front);
  CHECK(list[1].on_front);
  CHECK_FALSE(list[2].on_front);
  CHECK(list[3].on_front);
  CHECK_FALSE(list[4].on_front);
}

TEST_CASE("the JSON holds where, how and every figure; null where there is none") {
  const nlohmann::json json = to_json(report());
  for (const char* key : {"program", "processor", "compiler", "flags", "date", "baseline"}) {
    CAPTURE(key);
    CHECK_FALSE(json.at(key).get<std::string>().empty());
  }
  CHECK(json.at("samples") == SampleInputs::kBlock);
  CHECK(json.at("repetitions") == 2);
  REQUIRE(json.at("entries").size() == report().entries.size());
  for (const auto& e : json.at("entries")) {
    CAPTURE(e.dump());
    CHECK(e.size() == 14);
    CHECK(e.at("name").get<std::string>().starts_with(e.at("distribution").get<std::string>()));
    check_timing(e.at("coherent_ns"));
    check_timing(e.at("incoherent_ns"));
    CHECK(e.at("on_front").is_boolean());
    for (const char* key : {"bytes", "build_seconds", "coherent_ratio", "incoherent_ratio"})
      CHECK(e.at(key).is_number());
    for (const char* key : {"u_error", "density_error", "tail_ratio"})
      CHECK((e.at(key).is_number() || e.at(key).is_null()));
    const bool stored = e.at("kind") == "table";
    if (stored)
      check_timing(e.at("setup_ms"));
    else
      CHECK(e.at("setup_ms").is_null());
  }
  CHECK(nlohmann::json::parse(json.dump()) == json);
}

TEST_CASE("the table for people has a row for each sampler and a dash where there is no figure") {
  const std::string text = describe(report());
  for (const SpeedEntry& e : report().entries) CHECK_THAT(text, contains("| " + e.name));
  CHECK_THAT(text, contains(" | - | - | - |"));
  CHECK_THAT(text, contains(report().circumstances.date));
}

TEST_CASE("the picture names its output, its distributions and where it was taken") {
  const std::string script = speed_plot(report(), "svg", "out.svg");
  CHECK_THAT(script, contains("set output 'out.svg'") && contains("set terminal svg") &&
                         contains("set title 'ggx'") && contains("Pareto front") &&
                         contains(report().circumstances.processor));
  SpeedReport nothing = report();
  nothing.entries = {made_up("a", 1, std::nullopt)};
  CHECK_THROWS_AS(speed_plot(nothing, "svg", "out.svg"), std::invalid_argument);
}

TEST_CASE("the picture leaves out series that have no entries, which gnuplot cannot draw") {
  SpeedReport few = report();
  few.entries = {entry("ggx caps as published"), entry("ggx linear 16")};
  const std::string script = speed_plot(few, "svg", "out.svg");
  CHECK_THAT(script, contains("tables, linear rows") && !contains("tables, cubic rows"));
  CHECK(script.find("EOD\nEOD") == std::string::npos);
  CHECK(script.find("nan") == std::string::npos);
}

TEST_CASE("a run without samplers is refused") {
  CHECK_THROWS_AS(measure_speed({}, {}), std::invalid_argument);
}
