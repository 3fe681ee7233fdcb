// vndf sample: draws normals from a table file, in single precision as a renderer would.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <iostream>
#include <iterator>
#include <limits>
#include <memory>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "commands/arguments.h"
#include "commands/commands.h"
#include "commands/output_file.h"
#include "commands/sample_line.h"
#include "commands/surface_options.h"
#include "commands/table_files.h"
#include "vndf/on_surface.h"
#include "vndf/tabulated_sampler.h"

namespace vndf::tools {
namespace {

struct SampleArguments {
  std::string file;
  std::vector<double> wi, alpha;
  SurfaceArguments surface;
  std::size_t count = 10;
  std::uint64_t seed = 1;
  bool from_stdin = false, in_double = false, records = false;
};

/// A sampler of tables, and whether they have directions below the horizon.
template <class Sampler>
struct Source {
  using T = typename Sampler::Scalar;

  const Sampler& sampler;
  bool sees_below;

  /// The first rule that `in` breaks, or an empty string.
  std::string broken_rule(const SampleInputs& in) const {
    std::string rule = tools::broken_rule<T>(in);
    if (rule.empty() && !sees_below && in.surface.surface<double>().projected_area(in.wi) < 0)
      rule =
          "wi is behind the mean facet, and the tables were baked with --above-only; bake them "
          "without it";
    return rule;
  }

  struct Drawn {
    Vec3<T> m;
    T pdf;
  };

  Drawn draw(const SampleInputs& in) const {
    const Vec3<T> wi{static_cast<T>(in.wi.x), static_cast<T>(in.wi.y), static_cast<T>(in.wi.z)};
    const OnSurface<Sampler> on(sampler, in.surface.surface<T>());
    const Vec3<T> m = on.sample(wi, static_cast<T>(in.u1), static_cast<T>(in.u2));
    return {m, on.pdf(wi, m)};
  }
};

/// Appends `numbers` of precision T with `separator` between, and the end of the line.
template <class T, std::size_t N>
void append_line(fmt::memory_buffer& out, const std::array<T, N>& numbers, char separator) {
  for (std::size_t i = 0; i < N; ++i) {
    if (i > 0) out.push_back(separator);
    fmt::format_to(std::back_inserter(out), "{:.{}g}", numbers[i],
                   std::numeric_limits<T>::max_digits10);
  }
  out.push_back('\n');
}

void flush(fmt::memory_buffer& out, std::size_t limit) {
  if (out.size() < limit) return;
  std::cout.write(out.data(), static_cast<std::streamsize>(out.size()));
  out.clear();
  if (!std::cout) require_printed();
}

constexpr std::size_t kChunk = 1 << 16;

/// Answers the next line of standard input. Returns false at its end.
template <class Sampler>
bool answer_line(const Source<Sampler>& source, fmt::memory_buffer& out) {
  std::string line;
  if (!next_sample_line(std::cin, line)) return false;
  const SampleInputs inputs = inputs_of(line);
  if (const std::string rule = source.broken_rule(inputs); !rule.empty())
    throw std::runtime_error(rule);
  const auto [m, pdf] = source.draw(inputs);
  const auto slope = slope_of(m);
  append_line(out, std::array{slope.x, slope.y, m.x, m.y, m.z, pdf}, ' ');
  return true;
}

template <class Sampler>
void sample_lines(const Source<Sampler>& source) {
  fmt::memory_buffer out;
  std::size_t number = 1;
  try {
    for (; answer_line(source, out); ++number) flush(out, kChunk);
  } catch (const std::exception& e) {
    flush(out, 1);  // the lines before the refused one are answered
    throw std::runtime_error(fmt::format("standard input, line {}: {}", number, e.what()));
  }
  flush(out, 1);
}

/// The direction as given, brought to unit length, on the surface as given or `recorded`.
template <class T>
SampleInputs from_options(const SampleArguments& a, const std::optional<SurfaceSlopes>& recorded) {
  const double length = std::hypot(a.wi[0], a.wi[1], a.wi[2]);
  if (length == 0) throw CLI::ValidationError("--wi", "must not be the zero vector");
  const Alpha<double> alpha =
      a.alpha.empty() ? Alpha<double>{1, 1} : Alpha<double>{a.alpha.front(), a.alpha.back()};
  const SampleInputs inputs{{a.wi[0] / length, a.wi[1] / length, a.wi[2] / length},
                            surface_of(a.surface, alpha, a.file, recorded)};
  if (const std::string rule = broken_rule<T>(inputs); !rule.empty())
    throw CLI::ValidationError("--wi, --alpha", rule);
  return inputs;
}

/// The columns of a record for `vndf check` that are the same for all samples. A flat surface has
/// none for correlation and mean slope.
struct RecordColumns {
  std::string names, values;
};

template <class T>
RecordColumns record_columns(const SampleInputs& in) {
  constexpr int kDigits = std::numeric_limits<T>::max_digits10;
  const auto& [alpha, correlation, mean] = in.surface;
  RecordColumns columns{"wx,wy,wz,ax,ay,",
                        fmt::format("{:.{}g},{:.{}g},{:.{}g},{},{},", in.wi.x, kDigits, in.wi.y,
                                    kDigits, in.wi.z, kDigits, alpha.x, alpha.y)};
  if (in.surface.surface<T>().is_flat()) return columns;
  columns.names += "correlation,mean_x,mean_y,";
  columns.values += fmt::format("{},{},{},", correlation, mean.x, mean.y);
  return columns;
}

template <class Sampler>
void sample_random(const Source<Sampler>& source, const SampleArguments& arguments,
                   SampleInputs inputs) {
  using T = typename Sampler::Scalar;
  // Whole multiples of 2^-24 or 2^-53 below 1, which T holds exactly.
  constexpr int kBits = std::numeric_limits<T>::digits;
  std::mt19937_64 random(arguments.seed);
  const auto next = [&] {
    return std::ldexp(static_cast<double>(random() >> (64 - kBits)), -kBits);
  };

  const auto columns = arguments.records ? record_columns<T>(inputs) : RecordColumns{};
  fmt::memory_buffer out;
  fmt::format_to(std::back_inserter(out), "{}u1,u2,{}mx,my,mz,pdf\n", columns.names,
                 arguments.records ? "" : "slope_x,slope_y,");
  for (std::size_t i = 0; i < arguments.count; ++i) {
    inputs.u1 = next();
    inputs.u2 = next();
    const auto [m, pdf] = source.draw(inputs);
    const Vec2<T> slope = slope_of(m);
    const T u1 = static_cast<T>(inputs.u1), u2 = static_cast<T>(inputs.u2);
    out.append(columns.values);
    if (arguments.records)
      append_line(out, std::array{u1, u2, m.x, m.y, m.z, pdf}, ',');
    else
      append_line(out, std::array{u1, u2, slope.x, slope.y, m.x, m.y, m.z, pdf}, ',');
    flush(out, kChunk);
  }
  flush(out, 1);
}

template <class Sampler>
void sample_from(const Source<Sampler>& source, const SampleArguments& arguments,
                 const std::optional<SurfaceSlopes>& recorded) {
  if (arguments.from_stdin) return sample_lines(source);
  const auto inputs = from_options<typename Sampler::Scalar>(arguments, recorded);
  if (const std::string rule = source.broken_rule(inputs); !rule.empty())
    throw std::runtime_error(arguments.file + ": " + rule);
  sample_random(source, arguments, inputs);
}

template <class T>
void sample(const SampleArguments& arguments) {
  if (!arguments.from_stdin && !arguments.surface.as_mapped)
    from_options<T>(arguments, {});  // wrong usage is told before the file is read
  const AnyTables tables = load_tables(arguments.file);
  const auto recorded = provenance_of(tables).surface;
  if (const auto* pair = std::get_if<io::TableFile>(&tables)) {
    const TabulatedSampler<T> sampler(pair->tables);
    return sample_from(Source<TabulatedSampler<T>>{sampler, true}, arguments, recorded);
  }
  if constexpr (std::is_same_v<T, double>) {
    throw std::runtime_error(arguments.file +
                             ": baked tables are sampled in single precision only; leave out "
                             "--double, or give the pair, a .h5 or .exr file");
  } else {
    const auto& baked = std::get<KernelTables>(tables);
    const Kernel kernel = baked.kernel();
    sample_from(Source<Kernel>{kernel, baked.header().below_bytes != 0}, arguments, recorded);
  }
}

}  // namespace

void add_sample(CLI::App& app) {
  auto* command = app.add_subcommand("sample",
                                     "Draw visible normals from a table file\n\n"
                                     "Each is a line of a CSV table: the random numbers, the "
                                     "slopes, the normal and its density per "
                                     "solid angle, in single precision as renderers have them.");
  const auto a = std::make_shared<SampleArguments>();
  command->add_option("file", a->file, "Table file")->required();
  auto* wi = command->add_option("--wi", a->wi, "Incident direction; scaled to length 1");
  wi->delimiter(',')->expected(3)->type_name("X,Y,Z");
  auto* alpha = command->add_option("--alpha", a->alpha, "Roughness along x and y");
  alpha->delimiter(',')->expected(1, 2)->type_name("AX[,AY]");
  auto* count = command->add_option("-n", a->count, "Number of samples")
                    ->check(whole_number())
                    ->capture_default_str();
  auto* seed = command->add_option("--seed", a->seed, "Seed of the random numbers")
                   ->check(whole_number())
                   ->capture_default_str();
  auto* records =
      command->add_flag("--records", a->records, "Print the columns that vndf check reads");
  auto* from_stdin = command->add_flag(
      "--stdin", a->from_stdin,
      std::string("Read lines '") + kLineForm + "', print lines 'slope_x slope_y mx my mz pdf'");
  command->add_flag("--double", a->in_double, "Sample in double precision");
  add_surface_options(*command, a->surface);
  for (auto* option : {wi, alpha, count, seed, records}) from_stdin->excludes(option);
  for (const char* option : {"--correlation", "--mean", "--rotate", "--as-mapped"})
    from_stdin->excludes(command->get_option(option));
  command->callback([a] {
    if (!a->from_stdin && (a->wi.empty() || (a->alpha.empty() && !a->surface.as_mapped)))
      throw CLI::RequiredError("--wi with --alpha or --as-mapped, or --stdin");
    a->in_double ? sample<double>(*a) : sample<float>(*a);
  });
}

}  // namespace vndf::tools
