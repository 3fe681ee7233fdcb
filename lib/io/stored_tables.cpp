// The two directions between a TableFile and the attributes and arrays of its file, name by name.
#include "io/stored_tables.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "io/crc64.h"
#include "io/refusal.h"

namespace vndf::io {
namespace {

using Shape = std::vector<std::size_t>;

constexpr char kRemake[] = "make the file again with its recipe";

std::string certificate_name(const std::string& figure) {
  return "certificate_" + figure;
}

// Names in messages.
template <class T>
constexpr const char* kTypeName = "";
template <>
constexpr const char* kTypeName<int> = "a 32-bit integer";
template <>
constexpr const char* kTypeName<double> = "a float64 number";
template <>
constexpr const char* kTypeName<std::string> = "a text of fixed length";
template <>
constexpr const char* kTypeName<std::vector<float>> = "float32";
template <>
constexpr const char* kTypeName<std::vector<double>> = "float64";

std::string text_of(const Shape& shape) {
  std::string text;
  for (const std::size_t n : shape) text += (text.empty() ? "" : " x ") + std::to_string(n);
  return shape.empty() ? "a single value" : text;
}

// To the file.

Array stored(const QuantileTable& table) {
  std::vector<float> values;
  values.reserve(table.rows() * table.columns());
  for (std::size_t i = 0; i < table.rows(); ++i)
    values.insert(values.end(), table.row(i), table.row(i) + table.columns());
  return {{table.rows(), table.columns()}, std::move(values)};
}

Array stored(const LogCurve<double>& curve) {
  std::vector<double> values;
  values.reserve(2 * curve.nodes().size());
  for (const auto& node : curve.nodes()) values.insert(values.end(), {node.value, node.tangent});
  return {{curve.nodes().size(), 2}, std::move(values)};
}

void check_size(const char* name, const QuantileTable& table) {
  if (std::max(table.rows(), table.columns()) > kMaxTableSide)
    throw Refusal(std::string("the ") + name + " table is larger than the format allows (" +
                      std::to_string(kMaxTableSide) + " rows or columns)",
                  "make a smaller one");
}

void check_size(const char* name, const LogCurve<double>& curve) {
  if (curve.nodes().size() > kMaxCurveNodes)
    throw Refusal(std::string("the curve ") + name + " is longer than the format allows (" +
                      std::to_string(kMaxCurveNodes) + " nodes)",
                  "make a shorter one");
}

void check_size(const char* name, const std::string& text) {
  if (text.size() > kMaxTextBytes || text.find('\0') != std::string::npos)
    throw Refusal(std::string("the text ") + name + " is longer than " +
                      std::to_string(kMaxTextBytes) + " bytes or has a zero byte in it",
                  "shorten it");
}

void check_can_be_stored(const TableFile& file) {
  if (!file.tables) throw Refusal("there are no tables to write", "set TableFile::tables");
  if (const auto broken = check(*file.tables))
    throw Refusal("the tables to write break a rule: " + *broken, "make them again");
  check_size("marginal", file.tables->marginal);
  check_size("conditional", file.tables->conditional);
  check_size("log_ndf", file.tables->log_ndf);
  check_size("log_backfacing", file.tables->log_backfacing);
  check_size("distribution", file.tables->distribution);
  check_size("recipe", file.provenance.recipe);
  check_size("program", file.provenance.program);
}

// From the file.

template <class T>
const T& attribute(const StoredTables& stored, const std::string& name) {
  const auto found = stored.attributes.find(name);
  if (found == stored.attributes.end())
    throw Refusal("the attribute '" + name + "' is missing", kRemake);
  if (const T* value = std::get_if<T>(&found->second)) return *value;
  throw Refusal("the attribute '" + name + "' is not " + kTypeName<T>, kRemake);
}

const Array& array(const StoredTables& stored, const std::string& name) {
  const auto found = stored.arrays.find(name);
  if (found == stored.arrays.end()) throw Refusal("the array '" + name + "' is missing", kRemake);
  return found->second;
}

template <class Values>
const Values& values_of(const Array& array, const std::string& name) {
  if (const Values* values = std::get_if<Values>(&array.values)) return *values;
  throw Refusal("the values of the array '" + name + "' are not " + kTypeName<Values>, kRemake);
}

void check_named(const StoredTables& stored, const std::string& name, const std::string& known) {
  const auto& found = attribute<std::string>(stored, name);
  if (found != known)
    throw Refusal(
        "its " + name + " '" + found + "' is unknown to this program, which knows '" + known + "'",
        "use the program that wrote it, or make the file again");
}

void check_version(const StoredTables& stored) {
  const int major = attribute<int>(stored, "format_major");
  const int minor = attribute<int>(stored, "format_minor");
  if (major != kFormatMajor)
    throw Refusal("its format version is " + std::to_string(major) + "." + std::to_string(minor) +
                      " and this program reads version " + std::to_string(kFormatMajor),
                  "use a newer program, or make the file again with this one");
}

void check_identity(const StoredTables& stored) {
  const auto type = stored.attributes.find("file_type");
  if (type == stored.attributes.end() || !std::holds_alternative<std::string>(type->second) ||
      std::get<std::string>(type->second) != kFileType)
    throw Refusal(std::string("its attribute 'file_type' is not '") + kFileType +
                      "', so another program wrote it",
                  "give a file written by vndf");
  check_version(stored);
  check_named(stored, "coordinates", kCoordinates);
  check_named(stored, "interpolation", kInterpolation);
}

QuantileTable table_of(const StoredTables& stored, const std::string& name) {
  const Array& a = array(stored, name);
  const auto in_range = [](std::size_t n, std::size_t least) {
    return n >= least && n <= kMaxTableSide;
  };
  if (a.shape.size() != 2 || !in_range(a.shape[0], 2) || !in_range(a.shape[1], 3))
    throw Refusal("the array '" + name + "' has the shape " + text_of(a.shape) +
                      ", not rows x columns, at least 2 x 3 and at most " +
                      text_of({kMaxTableSide, kMaxTableSide}),
                  kRemake);
  return {a.shape[0], a.shape[1], values_of<std::vector<float>>(a, name)};
}

LogCurve<double> curve_of(const StoredTables& stored, const std::string& name) {
  const Array& a = array(stored, name);
  if (a.shape.size() != 2 || a.shape[1] != 2 || a.shape[0] < 2 || a.shape[0] > kMaxCurveNodes)
    throw Refusal("the array '" + name + "' has the shape " + text_of(a.shape) +
                      ", not nodes x 2 with 2 to " + std::to_string(kMaxCurveNodes) + " nodes",
                  kRemake);
  const auto& values = values_of<std::vector<double>>(a, name);
  std::vector<LogCurveNode<double>> nodes;
  nodes.reserve(a.shape[0]);
  for (std::size_t i = 0; i < a.shape[0]; ++i) nodes.push_back({values[2 * i], values[2 * i + 1]});
  return {attribute<double>(stored, name + "_step"), std::move(nodes)};
}

SlopeTables tables_of(const StoredTables& stored) {
  return {.distribution = attribute<std::string>(stored, "distribution"),
          .mean_slope = attribute<double>(stored, "mean_slope"),
          .marginal = table_of(stored, "marginal"),
          .conditional = table_of(stored, "conditional"),
          .log_ndf = curve_of(stored, "log_ndf"),
          .log_backfacing = curve_of(stored, "log_backfacing")};
}

void check_content(const StoredTables& stored, const SlopeTables& tables) {
  if (attribute<std::string>(stored, "content_checksum") != hex_digits(content_checksum(tables)))
    throw Refusal("it is damaged: its tables do not match its attribute 'content_checksum'",
                  "copy it again, or make it again with its recipe");
}

std::shared_ptr<const SlopeTables> checked(SlopeTables tables) {
  try {
    return share(std::move(tables));
  } catch (const std::invalid_argument& broken) {
    throw Refusal(std::string("it breaks a rule of ") + broken.what(),
                  "correct the program that wrote it");
  }
}

Certificate certificate_of(const StoredTables& stored) {
  Certificate certificate;
  for_each_figure(certificate, [&](const std::string& name, double& value) {
    value = attribute<double>(stored, certificate_name(name));
  });
  return certificate;
}

}  // namespace

bool may_read(const Shape& shape) {
  if (shape.size() != 2 || shape[0] == 0 || shape[1] == 0) return false;
  const bool like_table = shape[0] <= kMaxTableSide && shape[1] <= kMaxTableSide;
  const bool like_curve = shape[0] <= kMaxCurveNodes && shape[1] <= 2;
  return like_table || like_curve;
}

StoredTables to_stored(const TableFile& file) {
  check_can_be_stored(file);
  const SlopeTables& tables = *file.tables;
  StoredTables result;
  result.attributes = {{"file_type", kFileType},
                       {"format_major", kFormatMajor},
                       {"format_minor", kFormatMinor},
                       {"program", file.provenance.program},
                       {"recipe", file.provenance.recipe},
                       {"distribution", tables.distribution},
                       {"coordinates", kCoordinates},
                       {"interpolation", kInterpolation},
                       {"mean_slope", tables.mean_slope},
                       {"log_ndf_step", tables.log_ndf.step()},
                       {"log_backfacing_step", tables.log_backfacing.step()},
                       {"content_checksum", hex_digits(content_checksum(tables))}};
  for_each_figure(file.certificate, [&](const std::string& name, double value) {
    result.attributes[certificate_name(name)] = value;
  });
  result.arrays = {{"marginal", stored(tables.marginal)},
                   {"conditional", stored(tables.conditional)},
                   {"log_ndf", stored(tables.log_ndf)},
                   {"log_backfacing", stored(tables.log_backfacing)}};
  return result;
}

TableFile from_stored(const StoredTables& stored) {
  check_identity(stored);
  SlopeTables tables = tables_of(stored);
  check_content(stored, tables);
  return {.tables = checked(std::move(tables)),
          .provenance = {.recipe = attribute<std::string>(stored, "recipe"),
                         .program = attribute<std::string>(stored, "program")},
          .certificate = certificate_of(stored)};
}

}  // namespace vndf::io
