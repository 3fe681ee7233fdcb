// vndf picture: both tables as colour maps over their own coordinates, drawn by gnuplot.
#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "commands/commands.h"
#include "commands/output_file.h"
#include "commands/table_files.h"
#include "report/gnuplot.h"
#include "vndf/pair_coordinates.h"
#include "vndf/table_coordinates.h"

namespace vndf::tools {
namespace {

struct PictureArguments {
  std::string file, output;
  bool force = false;
};

/// Tick marks: what is written at which coordinate.
struct Tick {
  std::string label;
  double place;
};

std::string ticks(const std::vector<Tick>& list) {
  std::string text;
  for (const auto& t : list)
    text += fmt::format("{}'{}' {:.6f}", text.empty() ? "" : ", ", t.label, t.place);
  return "(" + text + ")";
}

std::vector<Tick> theta_ticks(const SlopeTables& t) {
  const PairCoordinates at(t);
  std::vector<Tick> list;
  for (const double degrees : {0.0, 1.0, 5.0, 15.0, 30.0, 45.0, 60.0, 75.0, 90.0}) {
    const double theta = degrees * std::numbers::pi / 180;
    const auto c = bounded_cotangent(std::cos(theta), t.mean_slope * std::sin(theta));
    list.push_back({fmt::format("{}", degrees), at.marginal_row(c)});
  }
  return list;
}

std::vector<Tick> slope_ticks(const SlopeTables& t) {
  const PairCoordinates at(t);
  std::vector<Tick> list;
  for (const double x : {0.0, 0.1, 0.5, 1.0, 2.0, 5.0})
    if (x < t.mean_slope * t.support)
      list.push_back(
          {fmt::format("{}", x), at.conditional_row(bounded_from_slope(x / t.mean_slope))});
  if (t.conditional_rows.empty()) list.push_back({"∞", 1.0});
  return list;
}

std::vector<Tick> u1_ticks() {
  std::vector<Tick> list{{"0", 0}, {"1", 1}};
  for (const double u : {1e-4, 0.01, 0.1, 0.5, 0.9, 0.99})
    list.push_back({fmt::format("{:g}", u), marginal_column(probability(u))});
  return list;
}

std::vector<Tick> u2_ticks() {
  std::vector<Tick> list;
  for (const double u : {0.5, 0.8, 0.95, 0.99, 0.999, 0.99999, 1.0})
    list.push_back({fmt::format("{:g}", u), conditional_column(fold(probability(u)).p)});
  return list;
}

/// The values at 256 x 256 places, as a gnuplot matrix over [0, 1] x [0, 1].
std::string matrix(const QuantileTable& table) {
  constexpr int kPlaces = 256;
  std::string text;
  for (int i = 0; i < kPlaces; ++i) {
    for (int j = 0; j < kPlaces; ++j)
      text += fmt::format("{:.5f} ", table.lookup((i + 0.5) / kPlaces, (j + 0.5) / kPlaces));
    text += '\n';
  }
  return text;
}

std::string panel(const std::string& block, const std::string& title, const std::string& xlabel,
                  const std::string& ylabel, const std::vector<Tick>& x,
                  const std::vector<Tick>& y) {
  return fmt::format(
      "set title '{}'\nset xlabel '{}'\nset ylabel '{}'\nset xtics {} rotate by -45\nset ytics {}\n"
      "plot {} matrix using (($1 + 0.5) / 256):(($2 + 0.5) / 256):3 with image notitle\n",
      title, xlabel, ylabel, ticks(x), ticks(y), block);
}

std::string script(const SlopeTables& t, const std::string& output, const std::string& terminal) {
  std::string text = fmt::format("$marginal << EOD\n{}EOD\n$conditional << EOD\n{}EOD\n",
                                 matrix(t.marginal), matrix(t.conditional));
  text += fmt::format(
      "set terminal {} size 1200,560 font ',13' background 'white'\nset output '{}'\n"
      "set encoding utf8\nset multiplot layout 1,2\nset xrange [0:1]\nset yrange [0:1]\n"
      "set cbrange [0:1]\nset tics out nomirror\n"
      "set palette defined (0 '#440154', 0.25 '#3b528b', 0.5 '#21918c', 0.75 '#5ec962', 1 "
      "'#fde725')\n",
      terminal, output);
  const std::string value = t.marginal_map.empty() ? "σ(x) / σ(cot θ)" : "s, map(s) = σ(x)";
  text += panel("$marginal", "Marginal table (" + t.distribution + "): " + value, "u_1",
                "θ (degrees)", u1_ticks(), theta_ticks(t));
  text += panel("$conditional", "Conditional table: 2 σ(y / scale) - 1", "u_2", "|x|", u2_ticks(),
                slope_ticks(t));
  return text + "unset multiplot\n";
}

}  // namespace

void add_picture(CLI::App& app) {
  auto* command = app.add_subcommand("picture", "Draw both tables of a file (needs gnuplot)");
  const auto arguments = std::make_shared<PictureArguments>();
  command->add_option("file", arguments->file, "Table file")->required();
  command->add_option("-o,--output", arguments->output, "Picture to write: .png or .svg")
      ->type_name("FILE")
      ->required();
  add_force(*command, arguments->force);
  command->callback([arguments] {
    const std::string terminal = terminal_for(arguments->output);
    require_output(arguments->output, {arguments->file}, arguments->force);
    const io::TableFile file = load_pair(arguments->file);
    draw(arguments->output,
         [&](const std::string& name) { return script(*file.tables, name, terminal); });
  });
}

}  // namespace vndf::tools
