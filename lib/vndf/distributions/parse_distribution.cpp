// A specification is cut into pieces that remember their column.
#include "vndf/distributions/parse_distribution.h"

#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include "vndf/distributions/family_list.h"
#include "vndf/distributions/mixture.h"
#include "vndf/support/text.h"

namespace vndf::distributions {
namespace {

constexpr auto kNone = std::string_view::npos;
constexpr std::string_view kMixture = "mixture";

/// Part of a specification without the spaces around it.
class Piece {
 public:
  explicit Piece(const std::string& spec) : Piece(spec, 0, spec.size()) {}

  std::string_view text() const { return std::string_view(spec_).substr(begin_, end_ - begin_); }
  std::string quoted() const { return support::quoted(text()); }
  bool empty() const { return begin_ == end_; }

  /// The characters [from, to) of the text.
  Piece part(std::size_t from, std::size_t to = kNone) const {
    return {spec_, begin_ + from, to == kNone ? end_ : begin_ + to};
  }

  [[noreturn]] void refuse(const std::string& why) const {
    throw std::invalid_argument(why + " (column " + std::to_string(begin_ + 1) + " of " +
                                support::quoted(spec_, begin_) + ")");
  }

 private:
  Piece(const std::string& spec, std::size_t begin, std::size_t end)
      : spec_(spec), begin_(begin), end_(end) {
    while (begin_ < end_ && spec_[begin_] == ' ') ++begin_;
    while (begin_ < end_ && spec_[end_ - 1] == ' ') --end_;
  }

  const std::string& spec_;
  std::size_t begin_, end_;
};

/// The parts of `whole` between the separators at `positions`.
std::vector<Piece> split_at(const Piece& whole, const std::vector<std::size_t>& positions) {
  std::vector<Piece> parts;
  std::size_t begin = 0;
  for (const std::size_t position : positions) {
    parts.push_back(whole.part(begin, position));
    begin = position + 1;
  }
  parts.push_back(whole.part(begin));
  return parts;
}

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// Whether the '+' at `i` belongs to a number such as 1e+3.
bool in_exponent(std::string_view text, std::size_t i) {
  if (i < 2 || i + 1 >= text.size() || !is_digit(text[i + 1])) return false;
  const bool after_e = text[i - 1] == 'e' || text[i - 1] == 'E';
  return after_e && (is_digit(text[i - 2]) || text[i - 2] == '.');
}

std::vector<std::size_t> separators(std::string_view text, char separator) {
  std::vector<std::size_t> positions;
  for (std::size_t i = 0; i < text.size(); ++i)
    if (text[i] == separator && !(separator == '+' && in_exponent(text, i))) positions.push_back(i);
  return positions;
}

double number(const Piece& piece, const std::string& what) {
  if (piece.empty()) piece.refuse(what + " has no number");
  const auto value = support::finite_number(piece.text());
  if (!value) piece.refuse(what + " is " + piece.quoted() + ", which is not a finite number");
  return *value;
}

double positive_number(const Piece& piece, const std::string& what) {
  const double value = number(piece, what);
  if (!(value > 0)) piece.refuse(what + " is " + support::number_text(value) + "; it must be > 0");
  return value;
}

const FamilyInfo& family_called(const Piece& name) {
  std::vector<std::string> known;
  for (const auto& family : families()) {
    if (family.name == name.text()) return family;
    known.push_back(family.name);
  }
  if (name.empty()) name.refuse("a distribution is missing; known: " + support::listed(known));
  const std::string nearest = support::did_you_mean(name.text(), known);
  name.refuse("no distribution is called " + name.quoted() + nearest +
              (nearest.empty() ? "; known: " : " known: ") + support::listed(known));
}

/// Index among the parameters of `family`.
std::size_t parameter_called(const FamilyInfo& family, const Piece& name) {
  std::vector<std::string> known;
  for (const auto& parameter : family.accepts) {
    if (parameter.name == name.text()) return known.size();
    known.push_back(parameter.name);
  }
  if (known.empty()) name.refuse(family.name + " takes no parameters");
  if (name.empty())
    name.refuse(family.name + ": a parameter has no name; known: " + support::listed(known));
  const std::string nearest = support::did_you_mean(name.text(), known);
  name.refuse(family.name + " has no parameter " + name.quoted() +
              (nearest.empty() ? "; known: " + support::listed(known) : nearest));
}

void require_range(const Piece& piece, const std::string& family, const FamilyParameter& parameter,
                   double value) {
  if (value >= parameter.least && value <= parameter.greatest) return;
  piece.refuse(family + ": " + parameter.name + " is " + support::number_text(value) +
               "; it must be from " + parameter.range() + ", where tables keep a u-error of " +
               support::number_text(kRangeUError));
}

/// NAME=NUMBER,... over the defaults.
std::vector<double> parse_parameters(const FamilyInfo& family, const Piece& all) {
  std::vector<std::optional<double>> given(family.accepts.size());
  for (const Piece& piece : split_at(all, separators(all.text(), ','))) {
    if (piece.empty()) piece.refuse(family.name + ": a parameter is missing after ':' or ','");
    const std::size_t equals = piece.text().find('=');
    const Piece name = piece.part(0, equals == kNone ? piece.text().size() : equals);
    const std::size_t index = parameter_called(family, name);
    if (equals == kNone)
      piece.refuse(family.name + ": '=' and a number are missing after " + name.quoted());
    if (given[index]) piece.refuse(family.name + ": " + name.quoted() + " is given twice");
    given[index] = number(piece.part(equals + 1), family.name + ": " + std::string(name.text()));
    require_range(piece, family.name, family.accepts[index], *given[index]);
  }
  std::vector<double> values;
  for (std::size_t i = 0; i < given.size(); ++i)
    values.push_back(given[i].value_or(family.accepts[i].default_value));
  return values;
}

std::unique_ptr<SlopeDistribution> parse_family(const Piece& piece) {
  const std::size_t colon = piece.text().find(':');
  const FamilyInfo& family =
      family_called(piece.part(0, colon == kNone ? piece.text().size() : colon));
  if (!family.make) piece.refuse("a mixture needs components: mixture:0.7*ggx+0.3*beckmann@0.2");
  std::vector<double> values;
  for (const auto& parameter : family.accepts) values.push_back(parameter.default_value);
  if (colon == kNone) return family.make(values);
  return family.make(parse_parameters(family, piece.part(colon + 1)));
}

/// Two lobes with roughnesses farther apart need a map with more nodes.
double roughness(const Piece& piece) {
  const double value = number(piece, "mixture: the roughness");
  if (!(value >= kLeastRoughness && value <= kGreatestRoughness))
    piece.refuse("mixture: the roughness is " + support::number_text(value) + "; it must be from " +
                 support::number_text(kLeastRoughness) + " to " +
                 support::number_text(kGreatestRoughness));
  return value;
}

/// WEIGHT*FAMILY[:PARAMETERS][@ROUGHNESS]
Mixture::Component parse_component(const Piece& piece) {
  if (piece.empty()) piece.refuse("mixture: a component is empty");
  const std::size_t star = piece.text().find('*');
  if (star == kNone)
    piece.refuse("mixture: component " + piece.quoted() + " has no weight; write WEIGHT*FAMILY");
  const double weight = positive_number(piece.part(0, star), "mixture: the weight");
  const Piece rest = piece.part(star + 1);
  const std::size_t at = rest.text().rfind('@');
  const Piece family = rest.part(0, at == kNone ? rest.text().size() : at);
  if (family.text().substr(0, kMixture.size()) == kMixture)
    family.refuse("mixture: a mixture cannot hold a mixture");
  return {weight, parse_family(family), at == kNone ? 1 : roughness(rest.part(at + 1))};
}

std::unique_ptr<SlopeDistribution> parse_mixture(const Piece& all) {
  const auto pieces = split_at(all, separators(all.text(), '+'));
  if (pieces.size() > kMaxComponents)
    all.refuse("mixture: it has " + std::to_string(pieces.size()) + " components; at most " +
               std::to_string(kMaxComponents) + " are allowed");
  std::vector<Mixture::Component> components;
  for (const Piece& piece : pieces) components.push_back(parse_component(piece));
  return std::make_unique<Mixture>(std::move(components));
}

}  // namespace

std::unique_ptr<SlopeDistribution> parse_distribution(const std::string& spec) {
  const Piece whole(spec);
  if (spec.size() > kMaxDistributionLength)
    whole.refuse("the name of the distribution has " + std::to_string(spec.size()) +
                 " characters; at most " + std::to_string(kMaxDistributionLength) + " are allowed");
  const std::size_t colon = whole.text().find(':');
  if (colon != kNone && whole.part(0, colon).text() == kMixture)
    return parse_mixture(whole.part(colon + 1));
  return parse_family(whole);
}

}  // namespace vndf::distributions
