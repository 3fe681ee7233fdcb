// Compiles formulas by muParser. A parser must not be shared between threads, so each thread
// compiles its own from the definition that the objects share.
#include "vndf/distributions/compiled_formula.h"

#include <muParser.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <set>
#include <stdexcept>
#include <string_view>
#include <unordered_map>

#include "vndf/support/text.h"

namespace vndf::distributions {

struct CompiledFormula::Definition {
  Formula formula;
  std::vector<std::string> variables;
  std::set<std::string> used;  ///< every name in the formula
  std::string shown;
};

namespace {

using Definition = CompiledFormula::Definition;

/// An angle with its cosine, sine and tangent, which near pi / 2 it does not determine in double
/// precision.
struct KnownAngle {
  double theta = std::numeric_limits<double>::quiet_NaN(), cosine = 0, sine = 0, tangent = 0;
};

double cosine_of(void* known, double x) {
  const auto& angle = *static_cast<KnownAngle*>(known);
  return x == angle.theta ? angle.cosine : std::cos(x);
}

double sine_of(void* known, double x) {
  const auto& angle = *static_cast<KnownAngle*>(known);
  return x == angle.theta ? angle.sine : std::sin(x);
}

double tangent_of(void* known, double x) {
  const auto& angle = *static_cast<KnownAngle*>(known);
  return x == angle.theta ? angle.tangent : std::tan(x);
}

double power_of(double x, double y) {
  return std::pow(x, y);
}

/// Defines our names beside those of muParser. `angle` must outlive the parser.
void define_names(mu::Parser& parser, KnownAngle& angle) {
  parser.DefineFun("pow", power_of);
  parser.DefineFunUserData("cos", cosine_of, &angle, false);
  parser.DefineFunUserData("sin", sine_of, &angle, false);
  parser.DefineFunUserData("tan", tangent_of, &angle, false);
  parser.DefineConst("pi", std::numbers::pi);
  parser.DefineConst("e", std::numbers::e);
}

/// A parser of one thread, and the storage that it reads.
struct Instance {
  explicit Instance(const Definition& definition) {
    define_names(parser, angle);
    for (const auto& [name, value] : definition.formula.parameters) parser.DefineConst(name, value);
    for (std::size_t i = 0; i < definition.variables.size(); ++i)
      parser.DefineVar(definition.variables[i], &values.at(i));
    parser.SetExpr(definition.formula.text);
  }
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;

  mu::Parser parser;
  std::array<double, 2> values{};
  KnownAngle angle;
};

/// Returns the calling thread's parser of a definition. Parsers of definitions that are gone are
/// removed when a new one is made. Until then no definition can have the same address, because the
/// weak pointer keeps the memory of make_shared.
Instance& instance_of(const std::shared_ptr<const Definition>& definition) {
  struct Entry {
    std::weak_ptr<const Definition> owner;
    std::unique_ptr<Instance> instance;
  };
  thread_local std::unordered_map<const Definition*, Entry> entries;
  const auto found = entries.find(definition.get());
  if (found != entries.end()) return *found->second.instance;
  std::erase_if(entries, [](const auto& entry) { return entry.second.owner.expired(); });
  Entry& entry = entries[definition.get()];
  entry = {definition, std::make_unique<Instance>(*definition)};
  return *entry.instance;
}

bool is_digit(char c) {
  return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

bool starts_name(char c) {
  return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_';
}

bool continues_name(char c) {
  return starts_name(c) || is_digit(c);
}

template <class List>
bool contains(const List& list, const std::string& name) {
  return std::find(list.begin(), list.end(), name) != list.end();
}

/// A name in a formula and where it starts.
struct Name {
  std::string text;
  std::size_t position;
  bool called;  ///< followed by '('
};

/// Returns the names in `text`, which the e of a number such as 1e-3 is not.
std::vector<Name> names_in(const std::string& text) {
  std::vector<Name> names;
  for (std::size_t i = 0; i < text.size();) {
    std::size_t end = i + 1;
    if (starts_name(text[i])) {
      while (end < text.size() && continues_name(text[end])) ++end;
      const std::size_t next = text.find_first_not_of(' ', end);
      names.push_back({text.substr(i, end - i), i, next != std::string::npos && text[next] == '('});
    } else if (is_digit(text[i]) || text[i] == '.') {
      double number = 0;
      const char* begin = text.data() + i;
      const char* after = std::from_chars(begin, text.data() + text.size(), number).ptr;
      end = i + std::max<std::size_t>(1, static_cast<std::size_t>(after - begin));
    }
    i = end;
  }
  return names;
}

[[noreturn]] void fail(const std::string& text, std::size_t position, const std::string& why) {
  throw std::invalid_argument("formula " + support::quoted(text, position) + ", column " +
                              std::to_string(position + 1) + ": " + why);
}

/// The names that a formula may use.
struct KnownNames {
  explicit KnownNames(const Definition& definition) : values(definition.variables) {
    mu::Parser parser;
    KnownAngle angle;
    define_names(parser, angle);
    for (const auto& function : parser.GetFunDef()) functions.push_back(function.first);
    for (const auto& constant : parser.GetConst()) constants.push_back(constant.first);
    for (const auto& parameter : definition.formula.parameters) values.push_back(parameter.first);
    values.insert(values.end(), {"pi", "e"});
  }
  std::vector<std::string> functions, constants, values;
};

std::string about_parameter(const Formula& formula, const std::string& name) {
  return "formula " + support::quoted(formula.text) + ": parameter " + support::quoted(name) + " ";
}

/// Throws for a parameter that no formula could use. Other messages list the names, which must be
/// printable and short by then.
void check_parameter_names(const Formula& formula) {
  for (const auto& parameter : formula.parameters) {
    const std::string& name = parameter.first;
    if (name.empty() || !starts_name(name[0]) ||
        !std::all_of(name.begin(), name.end(), continues_name))
      throw std::invalid_argument(about_parameter(formula, name) +
                                  "is not a name: letters, digits and _");
    if (name.size() > kMaxParameterName)
      throw std::invalid_argument(about_parameter(formula, name) + "has a name of more than " +
                                  std::to_string(kMaxParameterName) + " characters; shorten it");
  }
}

void check_parameters(const Definition& definition, const KnownNames& known) {
  for (const auto& [name, value] : definition.formula.parameters) {
    const std::string start = about_parameter(definition.formula, name);
    if (contains(definition.variables, name))
      throw std::invalid_argument(start + "has the name of a variable of the formula");
    if (contains(known.functions, name) || contains(known.constants, name))
      throw std::invalid_argument(start + "has the name of a function or a constant");
    if (!std::isfinite(value))
      throw std::invalid_argument(start + "is " + support::number_text(value) +
                                  "; it must be finite");
    if (definition.used.count(name) == 0)
      throw std::invalid_argument(start + "is not used by the formula");
  }
}

void check_name(const Name& name, const std::string& text, const KnownNames& known) {
  const std::string quoted = support::quoted(name.text);
  if (contains(known.functions, name.text)) {
    if (!name.called) fail(text, name.position, "function " + quoted + " needs '(' after it");
  } else if (!contains(known.values, name.text) && !contains(known.constants, name.text)) {
    const auto& candidates = name.called ? known.functions : known.values;
    const std::string nearest = support::did_you_mean(name.text, candidates);
    fail(text, name.position,
         (name.called ? "there is no function " : "nothing is called ") + quoted + nearest +
             (nearest.empty() ? "; known: " : " known: ") + support::listed(candidates));
  }
}

/// Throws for a formula that is too long, too deep or of too many parameters.
void check_size(const Formula& formula) {
  const std::string& text = formula.text;
  if (text.size() > kMaxFormulaLength)
    fail(text, kMaxFormulaLength,
         "the formula goes on beyond " + std::to_string(kMaxFormulaLength) +
             " characters; write it shorter, or give the density as a profile");
  if (formula.parameters.size() > kMaxFormulaParameters)
    throw std::invalid_argument("formula " + support::quoted(text) + ": it has " +
                                std::to_string(formula.parameters.size()) +
                                " parameters; at most " + std::to_string(kMaxFormulaParameters) +
                                " are allowed");
  std::size_t depth = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '(') ++depth;
    if (text[i] == ')' && depth > 0) --depth;
    if (depth > kMaxFormulaDepth)
      fail(text, i,
           "more than " + std::to_string(kMaxFormulaDepth) + " parentheses are open; nest fewer");
  }
}

/// Throws for "r = 2", which muParser would take for an assignment.
void check_no_assignment(const std::string& text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '=') continue;
    const bool compares = i + 1 < text.size() && text[i + 1] == '=';
    const bool ends_comparison =
        i > 0 && std::string_view("<>!").find(text[i - 1]) != std::string_view::npos;
    if (!compares && !ends_comparison) fail(text, i, "'=' would assign; '==' compares");
    if (compares) ++i;
  }
}

/// Returns what muParser means in our terms, because its own messages count columns from 0.
std::string explained(const mu::ParserError& error) {
  const std::string token = support::quoted(error.GetToken());
  switch (error.GetCode()) {
    case mu::ecUNEXPECTED_EOF:
      return "the formula ends where a value is expected";
    case mu::ecMISSING_PARENS:
      return "a ')' is missing";
    case mu::ecUNEXPECTED_VAL:
    case mu::ecUNEXPECTED_VAR:
    case mu::ecUNEXPECTED_FUN:
      return "an operator is expected before " + token;
    case mu::ecUNEXPECTED_OPERATOR:
      return "a value is expected in place of the operator " + token;
    case mu::ecUNEXPECTED_PARENS:
      return "unexpected " + token;
    case mu::ecUNEXPECTED_ARG_SEP:
      return "unexpected ','";
    case mu::ecTOO_MANY_PARAMS:
      return "too many arguments for " + token;
    case mu::ecTOO_FEW_PARAMS:
      return "too few arguments for " + token;
    case mu::ecMISSING_ELSE_CLAUSE:
      return "'?' without ':'";
    case mu::ecMISPLACED_COLON:
      return "':' without '?'";
    case mu::ecUNASSIGNABLE_TOKEN:
      return "cannot read " + token;
    default:
      return error.GetToken().empty() ? "cannot read the formula" : "unexpected " + token;
  }
}

void check_syntax(const Definition& definition) {
  const std::string& text = definition.formula.text;
  try {
    Instance instance(definition);
    instance.parser.Eval();
    if (instance.parser.GetNumResults() != 1)
      fail(text, text.find(','), "',' belongs between the arguments of a function");
  } catch (const mu::ParserError& error) {
    const int position = error.GetPos();
    fail(text, position < 0 ? text.size() : std::min(text.size(), std::size_t(position)),
         explained(error));
  }
}

}  // namespace

CompiledFormula::CompiledFormula(const Formula& formula,
                                 const std::vector<std::string>& variables) {
  Definition definition{formula, variables, {}, formula.text};
  for (const auto& [name, value] : formula.parameters)
    definition.shown += ", " + name + "=" + support::number_text(value);
  check_size(formula);
  check_parameter_names(formula);
  if (formula.text.find_first_not_of(' ') == std::string::npos)
    fail(formula.text, 0, "the formula is empty");
  const KnownNames known(definition);
  for (const Name& name : names_in(formula.text)) {
    check_name(name, formula.text, known);
    definition.used.insert(name.text);
  }
  check_parameters(definition, known);
  check_no_assignment(formula.text);
  check_syntax(definition);
  definition_ = std::make_shared<const Definition>(std::move(definition));
}

const std::string& CompiledFormula::text() const {
  return definition_->shown;
}

bool CompiledFormula::uses(const std::string& name) const {
  return definition_->used.count(name) > 0;
}

double CompiledFormula::operator()(double first, double second) const {
  Instance& instance = instance_of(definition_);
  instance.angle.theta = std::numeric_limits<double>::quiet_NaN();
  instance.values = {first, second};
  return instance.parser.Eval();
}

double CompiledFormula::at_slope(double r, double second) const {
  Instance& instance = instance_of(definition_);
  const double cosine = 1 / std::hypot(1, r);
  instance.angle = {std::atan(r), cosine, r * cosine, r};
  instance.values = {instance.angle.theta, second};
  return instance.parser.Eval();
}

}  // namespace vndf::distributions
