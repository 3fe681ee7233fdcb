// The list of contestants and how each is made.
#include "bench/entrants.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>
#include <stdexcept>

#include "bench/caps_batch.h"
#include "bench/literal_tables.h"
#include "bench/published_caps.h"
#include "io/table_file.h"
#include "precompute/build_tables.h"
#include "precompute/distribution_spec.h"
#include "vndf/reference/beckmann_analytic.h"
#include "vndf/reference/beckmann_exact.h"
#include "vndf/reference/beckmann_ndf.h"
#include "vndf/reference/ggx_analytic.h"
#include "vndf/reference/ggx_caps.h"
#include "vndf/reference/ggx_exact.h"
#include "vndf/reference/ggx_hemisphere.h"
#include "vndf/reference/ggx_ndf.h"
#include "vndf/reference/v_cavity.h"
#include "vndf/reference/walter_roughness.h"
#include "vndf/tabulated_sampler.h"

namespace vndf::bench {
namespace {

using precompute::BuiltTables;
using precompute::SlopeDistribution;

/// What `make` returns, and how long it took.
template <class Make>
auto timed(Make make, double& seconds) {
  const auto start = std::chrono::steady_clock::now();
  auto made = make();
  seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return made;
}

// Closed forms. A sampler of another law than that of visible Smith normals has no u-error.

template <class T, class Sampler>
Entrant reference(const std::string& name, const std::string& distribution,
                  std::optional<double> u_error) {
  return {distribution + " " + name, distribution, Kind::reference, 0, [u_error] {
            Contestant c = scalar_runs<T>(Sampler());
            c.errors.u = u_error;
            return c;
          }};
}

Entrant baseline() {
  return {"ggx caps as published", "ggx", Kind::baseline, 0, [] {
            Contestant c = scalar_runs<float>(PublishedCaps());
            c.errors.u = PublishedCaps::kFloatError;
            return c;
          }};
}

void add_ggx(std::vector<Entrant>& list) {
  const std::string d = "ggx";
  list.push_back(reference<float, GgxCaps<float>>("caps", d, GgxCapsMethod::kFloatError));
  list.push_back(
      reference<float, GgxHemisphere<float>>("hemisphere", d, GgxHemisphereMethod::kFloatError));
  list.push_back(
      reference<float, GgxAnalytic<float>>("analytic", d, GgxAnalyticMethod::kConeError));
  list.push_back(
      reference<float, GgxExact<float>>("exact, in double", d, GgxExactMethod::kFloatError));
  list.push_back(reference<float, GgxNdf<float>>("all normals", d, {}));
  list.push_back(
      reference<float, WalterRoughness<float, GgxNdf<float>>>("all normals, widened", d, {}));
  list.push_back(reference<float, VCavity<float, GgxNdf<float>>>("V-cavities", d, {}));
}

void add_beckmann(std::vector<Entrant>& list) {
  const std::string d = "beckmann";
  list.push_back(
      reference<float, BeckmannAnalytic<float>>("analytic", d, BeckmannAnalyticMethod::kConeError));
  list.push_back(reference<double, BeckmannAnalytic<double>>("analytic, double", d,
                                                             BeckmannAnalyticMethod::kConeError));
  list.push_back(reference<float, BeckmannExact<float>>("exact, in double", d,
                                                        BeckmannExactMethod::kFloatError));
  list.push_back(reference<float, BeckmannNdf<float>>("all normals", d, {}));
  list.push_back(
      reference<float, WalterRoughness<float, BeckmannNdf<float>>>("all normals, widened", d, {}));
  list.push_back(reference<float, VCavity<float, BeckmannNdf<float>>>("V-cavities", d, {}));
}

// Tables.

/// A table file that is gone with the last who uses it.
class ScratchFile {
 public:
  explicit ScratchFile(const BuiltTables& built) {
    std::string folder = (std::filesystem::temp_directory_path() / "vndf-bench-XXXXXX").string();
    if (mkdtemp(folder.data()) == nullptr)
      throw std::runtime_error(folder + ": cannot make a folder for table files; set TMPDIR");
    folder_ = folder;
    io::save(path(), {built.tables, {"vndf bench", "vndf bench"}, built.certificate});
  }
  ~ScratchFile() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;

  std::filesystem::path path() const { return folder_ / "tables.h5"; }

 private:
  std::filesystem::path folder_;
};

/// Loads the file and draws one sample.
std::function<void()> setup_from(const BuiltTables& built) {
  return [file = std::make_shared<const ScratchFile>(built)] {
    const TabulatedSampler<float> sampler(io::load(file->path()).tables);
    const volatile float used = sampler.sample(kCoherentWi, kCoherentAlpha, 0.25f, 0.75f).z;
    static_cast<void>(used);
  };
}

template <class Build>
Contestant tabulated(Build build) {
  double seconds = 0;
  const BuiltTables built = timed(build, seconds);
  Contestant c = scalar_runs<float>(TabulatedSampler<float>(built.tables));
  c.setup = setup_from(built);
  c.bytes = sampling_bytes(*built.tables);
  c.build_seconds = seconds;
  c.errors = errors_of(built.certificate);
  return c;
}

DirectionSpans directions(const SampleBlock& b) {
  return {b.wi_x, b.wi_y, b.wi_z};
}
NormalSpans normals(const SampleBlock& b) {
  return {b.wm_x, b.wm_y, b.wm_z};
}

Entrant batched_caps() {
  return {"ggx caps as published, batched", "ggx", Kind::reference, 0, [] {
            Contestant c;
            c.coherent = [](const Vec3<float>& wi, const Alpha<float>& alpha,
                            const SampleBlock& b) {
              caps_batch(wi, alpha, b.u1, b.u2, normals(b));
            };
            c.incoherent = [](const SampleBlock& b) {
              caps_batch(directions(b), {b.alpha_x, b.alpha_y}, b.u1, b.u2, normals(b));
            };
            c.errors.u = PublishedCaps::kFloatError;
            return c;
          }};
}

Contestant literal(const SlopeDistribution& distribution, std::size_t side) {
  double seconds = 0;
  LiteralErrors errors;
  const auto tables = timed(
      [&] {
        const precompute::UnitSlopes slopes(distribution, {});
        auto made = make_literal_tables(slopes, side, {});
        errors = measure_literal(slopes, made, {});
        return made;
      },
      seconds);
  Contestant c = scalar_runs<float>(LiteralSampler<float>(tables));
  c.bytes = tables->bytes();
  c.build_seconds = seconds;
  c.errors = {errors.max_u_error, errors.max_density_error, errors.tail_ratio};
  return c;
}

void add_tables(std::vector<Entrant>& list, const std::string& spec, const FieldOptions& options) {
  const std::shared_ptr<const SlopeDistribution> d = precompute::parse_distribution(spec);
  for (const std::size_t side : options.sides) {
    const std::string size = std::to_string(side);
    list.push_back({spec + " literal " + size, spec, Kind::literal, side,
                    [d, side] { return literal(*d, side); }});
    list.push_back(
        {spec + " linear " + size, spec, Kind::table, side, [d, side] {
           return tabulated([&] { return precompute::build_tables(*d, {.layout = {side, side}}); });
         }});
  }
}

}  // namespace

Errors errors_of(const Certificate& certificate) {
  const TableErrors &m = certificate.marginal, &c = certificate.conditional;
  const auto distance = [](double ratio) { return std::abs(std::log(ratio)); };
  const double farthest = std::max({m.lower.e6, m.upper.e6, c.lower.e6, c.upper.e6},
                                   [&](double a, double b) { return distance(a) < distance(b); });
  return {std::max(m.max_u_error, c.max_u_error),
          std::max(m.max_density_error, c.max_density_error), farthest};
}

const char* name_of(Kind kind) {
  switch (kind) {
    case Kind::baseline:
      return "baseline";
    case Kind::reference:
      return "reference";
    case Kind::literal:
      return "literal";
    case Kind::table:
      return "table";
    case Kind::compact:
      return "compact";
  }
  return "";
}

std::vector<Entrant> entrants(const FieldOptions& options) {
  std::vector<Entrant> list{baseline()};
  for (const std::string& spec : options.distributions) {
    if (spec == "ggx") add_ggx(list);
    if (spec == "ggx") list.push_back(batched_caps());
    if (spec == "beckmann") add_beckmann(list);
    add_tables(list, spec, options);
  }
  return list;
}

std::vector<Entrant> chosen(std::vector<Entrant> all, const std::vector<std::string>& words) {
  const auto holds = [](const Entrant& e, const std::string& word) {
    return e.name.find(word) != std::string::npos;
  };
  for (const std::string& word : words)
    if (std::ranges::none_of(all, [&](const Entrant& e) { return holds(e, word); }))
      throw std::invalid_argument("'" + word + "' occurs in no name, such as '" + all.back().name +
                                  "'; run without it to see all names");
  std::erase_if(all, [&](const Entrant& e) {
    return e.kind != Kind::baseline && !words.empty() &&
           std::ranges::none_of(words, [&](const std::string& word) { return holds(e, word); });
  });
  return all;
}

}  // namespace vndf::bench
