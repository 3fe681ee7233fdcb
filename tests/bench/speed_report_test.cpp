// The benchmark from the list of samplers to its report and picture. No time is asserted.
#include "vndf/bench/speed_report.h"

#include <cmath>
#include <set>
#include <stdexcept>

#include "support/catch.h"
#include "vndf/bench/cases.h"
#include "vndf/bench/speed_plot.h"

using namespace vndf;
using namespace vndf::bench;
using vndf::test::Approx;
using vndf::test::contains;

namespace {

/// Whether the sampler of this name draws many normals at a time, of which none waits for another.
bool draws_many(const std::string& name) {
  return name.find("batched") != std::string::npos || name.find("prepared") != std::string::npos;
}

/// What --quick does, and quicker.
CaseOptions few() {
  return {.distributions = {"ggx"}, .sides = {16}, .tolerances = {1e-4}};
}

SpeedReport quick_run() {
  SpeedOptions options;
  options.collect.repetitions = 2;
  options.collect.seconds = 1e-4;
  options.samples = 1;
  options.program = "vndf test";
  return measure_speed(all_cases(few()), options);
}

/// One run for all tests.
const SpeedReport& report() {
  static const SpeedReport made = quick_run();
  return made;
}

const SpeedEntry& entry(const std::string& name) {
  for (const SpeedEntry& e : report().entries)
    if (e.name == name) return e;
  throw std::runtime_error("no entry " + name);
}

SpeedEntry made_up(const std::string& distribution, const std::vector<double>& rounds,
                   std::optional<double> u_error) {
  SpeedEntry e;
  e.name = distribution + " made up";
  e.distribution = distribution;
  e.errors.u = u_error;
  e.coherent = e.incoherent = timing_of(rounds);
  return e;
}

/// A kernel in a picture.
SpeedEntry kernel(const std::string& name, std::size_t bytes, double ratio, double u_error) {
  SpeedEntry e = made_up("ggx", {1}, u_error);
  e.name = "ggx " + name;
  e.kind = Kind::kernel;
  e.bytes = bytes;
  e.incoherent_ratio.of_medians = ratio;
  return e;
}

/// The picture of the baseline and `entries`.
std::string picture_with(const std::vector<SpeedEntry>& entries) {
  SpeedReport r = report();
  r.entries = {entry("ggx caps as published")};
  r.entries.insert(r.entries.end(), entries.begin(), entries.end());
  return speed_plot(r, "svg", "out.svg");
}

void check_timing(const nlohmann::json& t) {
  CHECK(t.size() == 3);
  CHECK(t.at("lowest") > 0);
  CHECK(t.at("lowest") <= t.at("median"));
  CHECK(t.at("median") <= t.at("highest"));
}

}  // namespace

TEST_CASE("the cases are the baseline first, then references, tables and kernels") {
  const auto list = all_cases(CaseOptions());
  CHECK(list.front().kind == Kind::baseline);
  std::set<std::string> names;
  for (const Case& c : list) names.insert(c.name);
  CHECK(names.size() == list.size());
  for (const std::string& d : kUsualDistributions)
    for (const char* what : {" literal 1024", " linear 64", " kernel 1e-05", " kernel 0.0001 small",
                             " kernel 1e-05, batched"})
      CHECK(names.count(d + what) == 1);
  CHECK(names.count("beckmann analytic") == 1);
  CHECK(names.count("ggx caps") == 1);
}

TEST_CASE("the cases of a distribution stand together, by kind") {
  const auto list = all_cases(CaseOptions());
  std::vector<std::pair<std::string, Kind>> groups;
  for (std::size_t k = 1; k < list.size(); ++k) {
    const std::pair group{list[k].distribution, list[k].kind};
    if (groups.empty() || groups.back() != group) groups.push_back(group);
  }
  CHECK(std::set(groups.begin(), groups.end()).size() == groups.size());
  for (std::size_t k = 1; k < groups.size(); ++k)
    if (groups[k - 1].first == groups[k].first) CHECK(groups[k - 1].second < groups[k].second);
}

TEST_CASE("an unknown distribution is an error before any work") {
  CHECK_THROWS_WITH(all_cases({.distributions = {"gxx"}}), contains("gxx"));
}

TEST_CASE("parts of names choose samplers, and the baseline always runs") {
  const auto some = chosen(all_cases(few()), {"linear", "hemi"});
  REQUIRE(some.size() == 3);
  CHECK(some[0].kind == Kind::baseline);
  CHECK(some[1].name == "ggx hemisphere");
  CHECK(some[2].name == "ggx linear 16");
  CHECK(chosen(all_cases(few()), {}).size() == all_cases(few()).size());
  CHECK_THROWS_WITH(chosen(all_cases(few()), {"linear", "linaer"}), contains("'linaer'"));
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

TEST_CASE("every run of every sampler writes a unit normal for every sample") {
  Pollution pollution;
  for (const Case& c : all_cases(few())) {
    const Runner r = c.make();
    SampleInputs inputs(1);
    const SampleBlock b = inputs.next();
    const auto check = [&](const char* run) {
      for (std::size_t k = 0; k < b.size(); ++k) {
        CAPTURE(c.name, run, k);
        REQUIRE(std::abs(std::hypot(b.wm_x[k], b.wm_y[k], b.wm_z[k]) - 1) < 1e-5);
        b.wm_z[k] = 0;
        b.wm_x[k] = 0;
      }
    };
    r.coherent(kCoherentWi, kCoherentAlpha, b);
    check("coherent");
    r.incoherent(b);
    check("incoherent");
    const bool batch = draws_many(c.name);
    CHECK(bool(r.chained) == !batch);
    CHECK(bool(r.polluted) == !batch);
    if (batch) continue;
    r.chained(b);
    check("chained");
    r.polluted(b, pollution);
    check("polluted");
  }
}

TEST_CASE("a run yields every figure of every sampler") {
  REQUIRE(report().entries.size() == all_cases(few()).size());
  for (const SpeedEntry& e : report().entries) {
    CAPTURE(e.name);
    CHECK(e.coherent.median > 0);
    CHECK(e.incoherent.median > 0);
    for (const Ratio& r : {e.coherent_ratio, e.incoherent_ratio}) {
      CHECK(r.of_medians > 0);
      CHECK(r.of_lowest > 0);
      CHECK(r.in_rounds > 0);
    }
    const bool batch = draws_many(e.name);
    CHECK(e.chain.has_value() == !batch);
    CHECK(e.chain_ratio.has_value() == !batch);
    CHECK(e.polluted.has_value() == !batch);
    CHECK(e.polluted_ratio.has_value() == !batch);
    const bool stored = e.kind == Kind::table || e.kind == Kind::kernel;
    const bool measured = stored || e.kind == Kind::literal;
    CHECK(e.setup.has_value() == stored);
    CHECK((e.bytes > 0) == measured);
    CHECK((e.build_seconds > 0) == measured);
    CHECK(e.errors.density.has_value() == measured);
    CHECK(e.errors.tail_ratio.has_value() == measured);
  }
  const SpeedEntry& baseline = entry("ggx caps as published");
  CHECK(baseline.coherent_ratio.of_medians == 1);
  CHECK(baseline.incoherent_ratio.of_lowest == 1);
  CHECK(baseline.incoherent_ratio.in_rounds == 1);
  CHECK_FALSE(entry("ggx all normals").errors.u.has_value());
  CHECK(entry("ggx literal 16").bytes == 2 * 16 * 16 * sizeof(float));
}

TEST_CASE("ratios are to the first entry, fronts are per distribution") {
  std::vector<SpeedEntry> list{made_up("a", {10}, 1e-3), made_up("a", {20}, 1e-5),
                               made_up("a", {30}, 1e-4), made_up("b", {50}, 1e-2),
                               made_up("a", {1}, std::nullopt)};
  compare(list);
  CHECK(list[1].incoherent_ratio.of_medians == 2);
  CHECK(list[3].coherent_ratio.of_medians == 5);
  CHECK(list[0].on_front);
  CHECK(list[1].on_front);
  CHECK_FALSE(list[2].on_front);
  CHECK(list[3].on_front);
  CHECK_FALSE(list[4].on_front);
}

TEST_CASE("a ratio is of medians, of lowest times and the median within rounds") {
  // The last round was disturbed for both.
  std::vector<SpeedEntry> list{made_up("a", {4, 2, 80}, 1e-3), made_up("a", {8, 6, 240}, 1e-3)};
  list[0].chain = timing_of({5, 5, 5});
  list[1].chain = timing_of({10, 15, 20});
  list[1].polluted = timing_of({1, 1, 1});
  compare(list);
  const Ratio& r = list[1].incoherent_ratio;
  CHECK(r.of_medians == 2);
  CHECK(r.of_lowest == 3);
  CHECK(r.in_rounds == 3);
  CHECK(list[1].chain_ratio.value().of_medians == 3);
  CHECK_FALSE(list[1].polluted_ratio.has_value());
}

TEST_CASE("a machine is busy if the run had no whole processor or the baseline's times spread") {
  Environment at;
  CHECK_FALSE(busy(at));
  at.processor_share = 0.94;
  CHECK(busy(at));
  at.processor_share = 0.96;
  at.baseline_spread = 1.09;
  CHECK_FALSE(busy(at));
  at.baseline_spread = 1.11;
  CHECK(busy(at));
}

TEST_CASE("a report of a busy machine says so in one line") {
  SpeedReport r = report();
  r.environment.processor_share = 0.5;
  r.environment.baseline_spread = 1.25;
  CHECK_THAT(describe(r), contains("\nThe machine was busy, do not trust the figures: the run had "
                                   "50.0 % of a processor, and the baseline's median is 1.25 times "
                                   "its lowest time.\n"));
  CHECK(to_json(r).at("busy") == true);
  r.environment.processor_share = r.environment.baseline_spread = 1;
  CHECK_THAT(describe(r), !contains("busy"));
  CHECK(to_json(r).at("busy") == false);
}

TEST_CASE("the JSON holds where, how and every figure; null where there is none") {
  const nlohmann::json json = to_json(report());
  for (const char* key : {"program", "processor", "compiler", "flags", "date", "baseline"}) {
    CAPTURE(key);
    CHECK_FALSE(json.at(key).get<std::string>().empty());
  }
  CHECK(json.at("samples") == SampleInputs::kBlock);
  CHECK(json.at("repetitions") == 2);
  CHECK(json.at("busy").is_boolean());
  CHECK(json.at("processor_share") > 0);
  CHECK(json.at("baseline_spread") >= 1);
  REQUIRE(json.at("entries").size() == report().entries.size());
  for (const auto& e : json.at("entries")) {
    CAPTURE(e.dump());
    CHECK(e.size() == 22);
    CHECK(e.at("name").get<std::string>().starts_with(e.at("distribution").get<std::string>()));
    check_timing(e.at("coherent_ns"));
    check_timing(e.at("incoherent_ns"));
    CHECK(e.at("on_front").is_boolean());
    for (const char* key :
         {"bytes", "build_seconds", "coherent_ratio", "incoherent_ratio", "coherent_lowest_ratio",
          "incoherent_lowest_ratio", "coherent_round_ratio", "incoherent_round_ratio"})
      CHECK(e.at(key).is_number());
    const bool batch = draws_many(e.at("name"));
    for (const char* key : {"chain_ns", "chain_ratio", "polluted_ns", "polluted_ratio"})
      CHECK(e.at(key).is_null() == batch);
    for (const char* key : {"u_error", "density_error", "tail_ratio"})
      CHECK((e.at(key).is_number() || e.at(key).is_null()));
    if (e.at("kind") == "table" || e.at("kind") == "kernel")
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
  CHECK_THAT(text, contains(report().environment.date));
}

TEST_CASE("the picture names its output, its distributions and where it was taken") {
  const std::string script = speed_plot(report(), "svg", "out.svg");
  CHECK_THAT(script, contains("set output 'out.svg'") && contains("set terminal svg") &&
                         contains("set title 'ggx'") && contains("Pareto front") &&
                         contains(report().environment.processor));
  SpeedReport nothing = report();
  nothing.entries = {made_up("a", {1}, std::nullopt)};
  CHECK_THROWS_AS(speed_plot(nothing, "svg", "out.svg"), std::invalid_argument);
}

TEST_CASE("the picture leaves out series that have no entries, which gnuplot cannot draw") {
  const std::string script = picture_with({entry("ggx linear 16")});
  CHECK_THAT(script, contains("$table") && !contains("$literal") && !contains("$kernel"));
  CHECK(script.find("EOD\nEOD") == std::string::npos);
  CHECK(script.find("nan") == std::string::npos);
}

TEST_CASE("the picture draws samplers without tables alone as well") {
  const std::string script = picture_with({entry("ggx hemisphere")});
  CHECK_THAT(script, contains("hemisphere") && contains("plot NaN"));
  CHECK(script.find("inf") == std::string::npos);
}

TEST_CASE("the picture has a front of bytes and time for each power of ten of u-error") {
  const std::string script =
      picture_with({kernel("a", 4096, 1.5, 9e-5), kernel("b", 8192, 1.2, 8e-5),
                    kernel("c", 16384, 1.3, 7e-5), kernel("d", 16384, 1.1, 9e-6)});
  CHECK_THAT(script, contains("$front4 << EOD\n4096 1.5000\n8192 1.2000\n16384 1.1000\n") &&
                         contains("$front5 << EOD\n16384 1.1000\n") && !contains("$front3"));
}

TEST_CASE("the picture has one front where the finer kernels beat the others") {
  const std::string script =
      picture_with({kernel("a", 4096, 1.5, 9e-5), kernel("b", 2048, 1.2, 9e-6)});
  CHECK_THAT(script, contains("$front5") && !contains("$front4"));
}

TEST_CASE("the key beside a panel numbers the marks by their bytes") {
  const std::string script =
      picture_with({kernel("large", 4096, 1.5, 9e-5), kernel("small", 2048, 1.2, 9e-6)});
  CHECK_THAT(script, contains("' 1  small'") && contains("' 2  large'") &&
                         contains("'--  ggx caps as published: 1.00'"));
}

TEST_CASE("a run without samplers is an error") {
  CHECK_THROWS_AS(measure_speed({}, {}), std::invalid_argument);
}
