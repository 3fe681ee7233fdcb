// vndf sample: draws normals from a table file, in single precision as a renderer would.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <iostream>
#include <iterator>
#include <memory>
#include <random>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "commands/arguments.h"
#include "commands/commands.h"
#include "commands/output_file.h"
#include "commands/sample_line.h"
#include "commands/table_files.h"
#include "vndf/tabulated_sampler.h"

namespace vndf::tools {
namespace {

struct SampleArguments {
  std::string file;
  std::vector<double> wi, alpha;
  std::size_t count = 10;
  std::uint64_t seed = 1;
  bool from_stdin = false, in_double = false;
};

template <class T, class Sampler>
class Printer {
 public:
  explicit Printer(const Sampler& sampler) : sampler_(sampler) {}

  /// Appends "slope_x slope_y mx my mz pdf" with `separator` between.
  void append(fmt::memory_buffer& out, const SampleInputs& in, char separator) const {
    const auto t = [&](std::size_t i) { return static_cast<T>(in[i]); };
    const Vec3<T> wi{t(0), t(1), t(2)};
    const Alpha<T> alpha{t(3), t(4)};
    const Vec3<T> m = sampler_.sample(wi, alpha, t(5), t(6));
    const Vec2<T> slope = slope_of(m);
    const std::array<T, 6> numbers{slope.x, slope.y, m.x, m.y, m.z, sampler_.pdf(wi, m, alpha)};
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      if (i > 0) out.push_back(separator);
      fmt::format_to(std::back_inserter(out), "{:.{}g}", numbers[i], kDigits);
    }
    out.push_back('\n');
  }

  static constexpr int kDigits = std::numeric_limits<T>::max_digits10;

 private:
  const Sampler& sampler_;
};

void flush(fmt::memory_buffer& out, std::size_t limit) {
  if (out.size() < limit) return;
  std::cout.write(out.data(), static_cast<std::streamsize>(out.size()));
  out.clear();
  if (!std::cout) require_printed();
}

constexpr std::size_t kChunk = 1 << 16;

/// Answers the next line of standard input. Returns false at its end.
template <class T, class Sampler>
bool answer_line(const Printer<T, Sampler>& printer, fmt::memory_buffer& out) {
  std::string line;
  if (!next_sample_line(std::cin, line)) return false;
  const SampleInputs inputs = numbers_of(line);
  const std::string rule = broken_rule<T>(inputs);
  if (!rule.empty()) throw std::runtime_error(rule);
  printer.append(out, inputs, ' ');
  return true;
}

template <class T, class Sampler>
void sample_lines(const Sampler& sampler) {
  const Printer<T, Sampler> printer(sampler);
  fmt::memory_buffer out;
  std::size_t number = 1;
  try {
    for (; answer_line(printer, out); ++number) flush(out, kChunk);
  } catch (const std::exception& e) {
    flush(out, 1);  // the lines before the refused one are answered
    throw std::runtime_error(fmt::format("standard input, line {}: {}", number, e.what()));
  }
  flush(out, 1);
}

/// The direction as given, brought to unit length.
template <class T>
SampleInputs from_options(const SampleArguments& a) {
  const double length = std::hypot(a.wi[0], a.wi[1], a.wi[2]);
  if (length == 0) throw CLI::ValidationError("--wi", "must not be the zero vector");
  const SampleInputs inputs{
      a.wi[0] / length, a.wi[1] / length, a.wi[2] / length, a.alpha.front(), a.alpha.back(), 0, 0};
  if (const std::string rule = broken_rule<T>(inputs); !rule.empty())
    throw CLI::ValidationError("--wi, --alpha", rule);
  return inputs;
}

template <class T, class Sampler>
void sample_random(const Sampler& sampler, const SampleArguments& arguments) {
  const Printer<T, Sampler> printer(sampler);
  // Whole multiples of 2^-24 or 2^-53 below 1, which T holds exactly.
  constexpr int kBits = std::numeric_limits<T>::digits;
  std::mt19937_64 random(arguments.seed);
  const auto next = [&] {
    return std::ldexp(static_cast<double>(random() >> (64 - kBits)), -kBits);
  };

  SampleInputs inputs = from_options<T>(arguments);
  fmt::memory_buffer out;
  fmt::format_to(std::back_inserter(out), "u1,u2,slope_x,slope_y,mx,my,mz,pdf\n");
  for (std::size_t i = 0; i < arguments.count; ++i) {
    inputs[5] = next();
    inputs[6] = next();
    fmt::format_to(std::back_inserter(out), "{:.{}g},{:.{}g},", inputs[5], printer.kDigits,
                   inputs[6], printer.kDigits);
    printer.append(out, inputs, ',');
    flush(out, kChunk);
  }
  flush(out, 1);
}

template <class T, class Sampler>
void sample_from(const Sampler& sampler, const SampleArguments& arguments) {
  if (arguments.from_stdin)
    sample_lines<T>(sampler);
  else
    sample_random<T>(sampler, arguments);
}

template <class T>
void sample(const SampleArguments& arguments) {
  if (!arguments.from_stdin)
    from_options<T>(arguments);  // wrong usage is told before the file is read
  const AnyTables tables = load_tables(arguments.file);
  if (const auto* pair = std::get_if<io::TableFile>(&tables))
    return sample_from<T>(TabulatedSampler<T>(pair->tables), arguments);
  if constexpr (std::is_same_v<T, double>)
    throw std::runtime_error(arguments.file +
                             ": baked tables are sampled in single precision only; leave out "
                             "--double, or give the pair, a .h5 or .exr file");
  else
    sample_from<T>(std::get<KernelTables>(tables).kernel(), arguments);
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
  auto* wi = command->add_option("--wi", a->wi, "Incident direction, z >= 0; scaled to length 1");
  wi->delimiter(',')->expected(3)->type_name("X,Y,Z");
  auto* alpha = command->add_option("--alpha", a->alpha, "Roughness along x and y");
  alpha->delimiter(',')->expected(1, 2)->type_name("AX[,AY]");
  auto* count = command->add_option("-n", a->count, "Number of samples")
                    ->check(whole_number())
                    ->capture_default_str();
  auto* seed = command->add_option("--seed", a->seed, "Seed of the random numbers")
                   ->check(whole_number())
                   ->capture_default_str();
  auto* from_stdin = command->add_flag(
      "--stdin", a->from_stdin,
      "Read lines 'wx wy wz ax ay u1 u2', print lines 'slope_x slope_y mx my mz pdf'");
  command->add_flag("--double", a->in_double, "Sample in double precision");
  for (auto* option : {wi, alpha, count, seed}) from_stdin->excludes(option);
  command->callback([a] {
    if (!a->from_stdin && (a->wi.empty() || a->alpha.empty()))
      throw CLI::RequiredError("--wi and --alpha, or --stdin");
    a->in_double ? sample<double>(*a) : sample<float>(*a);
  });
}

}  // namespace vndf::tools
