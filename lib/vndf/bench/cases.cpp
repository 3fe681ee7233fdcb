// The list of cases and how each is made.
#include "vndf/bench/cases.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <sstream>
#include <stdexcept>

#include "vndf/batch/sample_batch.h"
#include "vndf/bench/caps_batch.h"
#include "vndf/bench/literal_tables.h"
#include "vndf/bench/published_caps.h"
#include "vndf/bench/shared_builds.h"
#include "vndf/distributions/parse_distribution.h"
#include "vndf/io/table_file.h"
#include "vndf/kernel_tables.h"
#include "vndf/precompute/bake_certified.h"
#include "vndf/precompute/build_tables.h"
#include "vndf/precompute/unit_slopes.h"
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

using distributions::SlopeDistribution;
using precompute::BuiltTables;

// Closed forms. A sampler that does not draw visible Smith normals has no u-error.

template <class T, class Sampler>
Case reference(const std::string& name, const std::string& distribution,
               std::optional<double> u_error) {
  return {distribution + " " + name, distribution, Kind::reference, [u_error] {
            Runner r = scalar_runs<T>(Sampler());
            r.errors.u = u_error;
            return r;
          }};
}

Case baseline() {
  return {"ggx caps as published", "ggx", Kind::baseline, [] {
            Runner r = scalar_runs<float>(PublishedCaps());
            r.errors.u = PublishedCaps::kFloatError;
            return r;
          }};
}

void add_ggx(std::vector<Case>& list) {
  const std::string d = "ggx";
  list.push_back(reference<float, GgxCaps<float>>("caps", d, GgxCapsMethod::kFloatError));
  list.push_back(
      reference<float, GgxHemisphere<float>>("hemisphere", d, GgxHemisphereMethod::kFloatError));
  list.push_back(
      reference<float, GgxAnalytic<float>>("analytic", d, GgxAnalyticMethod::kConeError));
  list.push_back(
      reference<float, GgxExact<float>>("exact, in double", d, GgxExactMethod::kFloatError));
  list.push_back(reference<float, GgxNdf<float>>("all normals", d, {}));
  list.push_back(reference<float, WalterRoughness<GgxNdf<float>>>("all normals, widened", d, {}));
  list.push_back(reference<float, VCavity<GgxNdf<float>>>("V-cavities", d, {}));
}

void add_beckmann(std::vector<Case>& list) {
  const std::string d = "beckmann";
  list.push_back(
      reference<float, BeckmannAnalytic<float>>("analytic", d, BeckmannAnalyticMethod::kConeError));
  list.push_back(reference<double, BeckmannAnalytic<double>>("analytic, double", d,
                                                             BeckmannAnalyticMethod::kConeError));
  list.push_back(reference<float, BeckmannExact<float>>("exact, in double", d,
                                                        BeckmannExactMethod::kFloatError));
  list.push_back(reference<float, BeckmannNdf<float>>("all normals", d, {}));
  list.push_back(
      reference<float, WalterRoughness<BeckmannNdf<float>>>("all normals, widened", d, {}));
  list.push_back(reference<float, VCavity<BeckmannNdf<float>>>("V-cavities", d, {}));
}

// Tables.

/// A temporary table file, which its destructor removes.
class ScratchFile {
 public:
  explicit ScratchFile(const BuiltTables& built) {
    std::string folder = (std::filesystem::temp_directory_path() / "vndf-bench-XXXXXX").string();
    if (mkdtemp(folder.data()) == nullptr)
      throw std::runtime_error(folder + ": cannot make a folder for table files; set TMPDIR");
    folder_ = folder;
    io::save(path(), {built.tables, Provenance(), built.certificate});
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

/// Tables with linear rows.
Runner tabulated(const Built<BuiltTables>& built) {
  const BuiltTables& tables = built.value;
  Runner r = scalar_runs<float>(TabulatedSampler<float>(tables.tables));
  r.setup = setup_from(tables);
  r.bytes = sampling_bytes(*tables.tables);
  r.build_seconds = built.seconds;
  r.errors = errors_of(tables.certificate);
  return r;
}

/// Rows and columns of the pairs that kernels are baked from, and a limit of bytes that none
/// reaches.
constexpr std::size_t kBakedSide = 1024, kMostBakedBytes = std::size_t{1} << 24;

std::string kernel_name(const std::string& spec, double tolerance, bool small) {
  std::ostringstream name;
  name << spec << " kernel " << tolerance << (small ? " small" : "");
  return name.str();
}

/// A distribution with the tables that its cases share.
struct Source {
  std::string spec;
  std::shared_ptr<const SlopeDistribution> distribution;
  std::shared_ptr<SharedBuilds> builds;

  auto slopes() const {
    return builds->get(spec + " slopes", [this] {
      return std::make_unique<const precompute::UnitSlopes>(*distribution, support::Workers{});
    });
  }
  auto tables(std::size_t side) const {
    return builds->get(spec + " linear " + std::to_string(side), [&] {
      return precompute::build_tables(*distribution, {.layout = {side, side}});
    });
  }
  /// Tables baked from the pair for a tolerance, either the fastest or the smallest ones.
  auto baked(double tolerance, bool small) const {
    const auto pair = tables(kBakedSide);
    const auto bake = [&](std::size_t max_bytes) {
      return precompute::bake_certified(*slopes()->value, *pair->value.tables,
                                        BakeOptions{tolerance, max_bytes}, KernelText{},
                                        support::Workers{});
    };
    const auto fast =
        builds->get(kernel_name(spec, tolerance, false), [&] { return bake(kMostBakedBytes); });
    if (!small) return fast;
    return builds->get(kernel_name(spec, tolerance, true), [&] {
      try {
        return bake(fast->value.sampling_bytes() * 3 / 4);
      } catch (const BakeError&) {
        return fast->value;  // nothing is smaller
      }
    });
  }
};

Runner literal(const Source& source, std::size_t side) {
  const auto slopes = source.slopes();
  const auto tables = timed([&] { return make_literal_tables(*slopes->value, side, {}); });
  const auto errors = timed([&] { return measure_literal(*slopes->value, tables.value, {}); });
  Runner r = scalar_runs<float>(LiteralSampler<float>(tables.value));
  r.bytes = tables.value->bytes();
  r.build_seconds = slopes->seconds + tables.seconds + errors.seconds;
  const LiteralErrors& e = errors.value;
  r.errors = {e.max_u_error, e.max_density_error, e.tail_ratio};
  return r;
}

void add_tables(std::vector<Case>& list, const Source& source,
                const std::vector<std::size_t>& sides) {
  const std::string& spec = source.spec;
  for (const std::size_t side : sides)
    list.push_back({spec + " literal " + std::to_string(side), spec, Kind::literal,
                    [source, side] { return literal(source, side); }});
  for (const std::size_t side : sides)
    list.push_back({spec + " linear " + std::to_string(side), spec, Kind::table,
                    [source, side] { return tabulated(*source.tables(side)); }});
}

// Kernels.

/// A runner with the setup, size and errors of baked tables, but without runs.
Runner baked_tables(const Built<KernelTables>& built) {
  Runner r;
  r.setup = [tables = built.value] {
    const Kernel kernel = KernelTables::view(tables.bytes()).kernel();
    const volatile float used = kernel.sample(kCoherentWi, kCoherentAlpha, 0.25f, 0.75f).z;
    static_cast<void>(used);
  };
  r.bytes = built.value.sampling_bytes();
  r.build_seconds = built.seconds;
  r.errors = errors_of(built.value.certificate());
  return r;
}

/// The kernel on a surface with correlated slopes and a mean slope at each alpha.
struct KernelOnSurfaces {
  Kernel kernel;

  Vec3<float> sample(const Vec3<float>& wi, const Alpha<float>& alpha, float u1, float u2) const {
    return kernel.sample(wi, RoughSurface<float>(alpha, 0.5f, {0.1f, -0.05f}), u1, u2);
  }
};

/// A sampler that runs the kernel of `built`: Kernel or KernelOnSurfaces. It refers to tables that
/// the cases own.
template <class Sampler>
Runner scalar_kernel(const Built<KernelTables>& built) {
  Runner r = scalar_runs<float>(Sampler{built.value.kernel()});
  const Runner known = baked_tables(built);
  r.setup = known.setup;
  r.bytes = known.bytes;
  r.build_seconds = known.build_seconds;
  r.errors = known.errors;
  return r;
}

/// The kernel with prepared directions, one for a whole block if the block is coherent.
Runner prepared_kernel(const Built<KernelTables>& built) {
  Runner r = baked_tables(built);
  const Kernel kernel = built.value.kernel();
  r.coherent = [kernel](const Vec3<float>& wi, const Alpha<float>& alpha, const SampleBlock& b) {
    const KernelDirection direction = kernel.at(wi, alpha);
    for (std::size_t k = 0; k < b.size(); ++k)
      write_normal(b, k, direction.sample(b.u1[k], b.u2[k]));
  };
  r.incoherent = [kernel](const SampleBlock& b) {
    for (std::size_t k = 0; k < b.size(); ++k)
      write_normal(
          b, k,
          kernel.at(direction_at<float>(b, k), alpha_at<float>(b, k)).sample(b.u1[k], b.u2[k]));
  };
  return r;
}

Runner batched_kernel(const Built<KernelTables>& built) {
  Runner r = baked_tables(built);
  const Kernel kernel = built.value.kernel();
  r.coherent = [kernel](const Vec3<float>& wi, const Alpha<float>& alpha, const SampleBlock& b) {
    sample_batch(kernel.at(wi, alpha), b.u1, b.u2, {b.wm_x, b.wm_y, b.wm_z});
  };
  r.incoherent = [kernel](const SampleBlock& b) {
    sample_batch(kernel, DirectionSpans{b.wi_x, b.wi_y, b.wi_z}, AlphaSpans{b.alpha_x, b.alpha_y},
                 b.u1, b.u2, {b.wm_x, b.wm_y, b.wm_z});
  };
  return r;
}

void add_kernels(std::vector<Case>& list, const Source& source,
                 const std::vector<double>& tolerances) {
  const auto add = [&](const std::string& name, double tolerance, bool small, auto runner) {
    list.push_back({name, source.spec, Kind::kernel, [=] {
                      // The runs refer to the tables, which the source keeps.
                      return runner(*source.baked(tolerance, small));
                    }});
  };
  for (const double tolerance : tolerances) {
    for (const bool small : {false, true})
      add(kernel_name(source.spec, tolerance, small), tolerance, small, scalar_kernel<Kernel>);
    const std::string fast = kernel_name(source.spec, tolerance, false);
    add(fast + ", prepared", tolerance, false, prepared_kernel);
    add(fast + ", batched", tolerance, false, batched_kernel);
    add(fast + ", on surfaces", tolerance, false, scalar_kernel<KernelOnSurfaces>);
  }
}

// Files.

void add_file(std::vector<Case>& list, const std::string& path) {
  if (!is_kernel_file(path)) {
    const auto file = std::make_shared<const io::TableFile>(io::load(path));
    list.push_back({path + " linear", path, Kind::table, [file] {
                      return tabulated({BuiltTables{file->tables, file->certificate, 1, 0}, 0});
                    }});
    return;
  }
  const auto built =
      std::make_shared<const Built<KernelTables>>(Built<KernelTables>{load(path), 0});
  list.push_back(
      {path + " kernel", path, Kind::kernel, [built] { return scalar_kernel<Kernel>(*built); }});
  list.push_back({path + " kernel, prepared", path, Kind::kernel,
                  [built] { return prepared_kernel(*built); }});
  list.push_back(
      {path + " kernel, batched", path, Kind::kernel, [built] { return batched_kernel(*built); }});
  list.push_back({path + " kernel, on surfaces", path, Kind::kernel,
                  [built] { return scalar_kernel<KernelOnSurfaces>(*built); }});
}

// Batches.

Case batched_caps() {
  return {"ggx caps as published, batched", "ggx", Kind::reference, [] {
            const auto normals = [](const SampleBlock& b) {
              return NormalSpans{b.wm_x, b.wm_y, b.wm_z};
            };
            Runner r;
            r.coherent = [normals](const Vec3<float>& wi, const Alpha<float>& alpha,
                                   const SampleBlock& b) {
              caps_batch(wi, alpha, b.u1, b.u2, normals(b));
            };
            r.incoherent = [normals](const SampleBlock& b) {
              caps_batch({b.wi_x, b.wi_y, b.wi_z}, {b.alpha_x, b.alpha_y}, b.u1, b.u2, normals(b));
            };
            r.errors.u = PublishedCaps::kFloatError;
            return r;
          }};
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
    case Kind::kernel:
      return "kernel";
  }
  return "";
}

std::vector<Case> all_cases(const CaseOptions& options) {
  std::vector<Case> list{baseline()};
  const auto builds = std::make_shared<SharedBuilds>();
  for (const std::string& spec : options.distributions) {
    if (spec == "ggx") add_ggx(list);
    if (spec == "ggx") list.push_back(batched_caps());
    if (spec == "beckmann") add_beckmann(list);
    const Source source{spec, distributions::parse_distribution(spec), builds};
    add_tables(list, source, options.sides);
    add_kernels(list, source, options.tolerances);
  }
  for (const std::string& path : options.files) add_file(list, path);
  return list;
}

std::vector<Case> chosen(std::vector<Case> all, const std::vector<std::string>& parts) {
  const auto holds = [](const Case& c, const std::string& part) {
    return c.name.find(part) != std::string::npos;
  };
  for (const std::string& part : parts)
    if (std::ranges::none_of(all, [&](const Case& c) { return holds(c, part); }))
      throw std::invalid_argument("'" + part + "' occurs in no name, such as '" + all.back().name +
                                  "'; run without it to see all names");
  std::erase_if(all, [&](const Case& c) {
    return c.kind != Kind::baseline && !parts.empty() &&
           std::ranges::none_of(parts, [&](const std::string& part) { return holds(c, part); });
  });
  return all;
}

}  // namespace vndf::bench
