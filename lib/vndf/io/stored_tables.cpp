// The two directions between a TableFile and the attributes and arrays of its file, name by name.
#include "vndf/io/stored_tables.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "vndf/io/content_checksum.h"
#include "vndf/io/crc64.h"
#include "vndf/io/format_error.h"
#include "vndf/io/stored_names.h"
#include "vndf/io/table_format.h"
#include "vndf/support/text.h"
#include "vndf/surface_slopes.h"

namespace vndf::io {
namespace {

using Shape = std::vector<std::size_t>;

constexpr std::size_t kSegmentColumns = 4;
constexpr char kRemake[] = "build the table again";

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

template <class V>
std::vector<V> values_of(const QuantileTable& table) {
  std::vector<V> values;
  values.reserve(table.rows() * table.columns());
  for (std::size_t i = 0; i < table.rows(); ++i)
    for (const double v : table.row_values(i)) values.push_back(static_cast<V>(v));
  return values;
}

Array stored(const QuantileTable& table) {
  const Shape shape{table.rows(), table.columns()};
  return table.in_double() ? Array{shape, values_of<double>(table)}
                           : Array{shape, values_of<float>(table)};
}

/// Without knots the axis is written as the identity that it is: a file has no empty arrays.
Array stored(std::vector<RowKnot> knots) {
  if (knots.empty()) knots = {{0, 0}, {1, 1}};
  std::vector<double> values;
  for (const auto& knot : knots) values.insert(values.end(), {knot.base, knot.row});
  return {{knots.size(), 2}, std::move(values)};
}

Array stored(const std::vector<CubicNode<double>>& nodes) {
  std::vector<double> values;
  for (const auto& node : nodes) values.insert(values.end(), {node.value, node.tangent});
  return {{nodes.size(), 2}, std::move(values)};
}

Array stored(const Specification& specification) {
  std::vector<double> values;
  for (std::size_t i = 0; i < specification.r.size(); ++i)
    values.insert(values.end(), {specification.r[i], specification.p22[i]});
  return {{specification.r.size(), 2}, std::move(values)};
}

std::size_t node_count(const LogCurve<double>& curve) {
  std::size_t count = 0;
  for (const auto& segment : curve.segments()) count += segment.nodes.size();
  return count;
}

/// The nodes of all segments, one after the other.
Array stored_nodes(const LogCurve<double>& curve) {
  std::vector<double> values;
  values.reserve(2 * node_count(curve));
  for (const auto& segment : curve.segments())
    for (const auto& node : segment.nodes) values.insert(values.end(), {node.value, node.tangent});
  return {{node_count(curve), 2}, std::move(values)};
}

/// Begin, end, grading and number of nodes of each segment.
Array stored_segments(const LogCurve<double>& curve) {
  std::vector<double> values;
  for (const auto& segment : curve.segments())
    values.insert(values.end(), {segment.begin, segment.end, static_cast<double>(segment.grading),
                                 static_cast<double>(segment.nodes.size())});
  return {{curve.segments().size(), kSegmentColumns}, std::move(values)};
}

void check_size(const char* name, const QuantileTable& table) {
  if (std::max(table.rows(), table.columns()) > kMaxTableSide)
    throw FormatError(std::string("the ") + name + " table is larger than the format allows (" +
                          std::to_string(kMaxTableSide) + " rows or columns)",
                      "make a smaller one");
}

void check_size(const char* name, const LogCurve<double>& curve) {
  if (node_count(curve) > kMaxCurveNodes)
    throw FormatError(std::string("the curve ") + name + " is longer than the format allows (" +
                          std::to_string(kMaxCurveNodes) + " nodes)",
                      "make a shorter one");
}

void check_can_be_stored(const TableFile& file) {
  if (!file.tables) throw FormatError("there are no tables to write", "set TableFile::tables");
  if (const auto rule = check(*file.tables))
    throw FormatError("the tables to write break a rule: " + *rule, "make them again");
  check_size("marginal", file.tables->marginal);
  check_size("conditional", file.tables->conditional);
  check_size("log_ndf", file.tables->log_ndf);
  check_size("log_backfacing", file.tables->log_backfacing);
  if (file.tables->marginal_map.size() > kMaxCurveNodes)
    throw FormatError("the map of the marginal table is longer than the format allows (" +
                          std::to_string(kMaxCurveNodes) + " nodes)",
                      "make a shorter one");
  auto broken = check_text("distribution", file.tables->distribution);
  if (!broken) broken = check(file.provenance);
  if (broken) throw FormatError(*broken, "shorten or correct it");
}

// From the file.

template <class T>
const T& attribute(const StoredTables& stored, const std::string& name) {
  const auto found = stored.attributes.find(name);
  if (found == stored.attributes.end())
    throw FormatError("the attribute '" + name + "' is missing", kRemake);
  if (const T* value = std::get_if<T>(&found->second)) return *value;
  throw FormatError("the attribute '" + name + "' is not " + kTypeName<T>, kRemake);
}

const Array& array(const StoredTables& stored, const std::string& name) {
  const auto found = stored.arrays.find(name);
  if (found == stored.arrays.end())
    throw FormatError("the array '" + name + "' is missing", kRemake);
  return found->second;
}

template <class Values>
const Values& values_of(const Array& array, const std::string& name) {
  if (const Values* values = std::get_if<Values>(&array.values)) return *values;
  throw FormatError("the values of the array '" + name + "' are not " + kTypeName<Values>, kRemake);
}

void check_coordinates(const StoredTables& stored) {
  const auto& name = attribute<std::string>(stored, "coordinates");
  if (name != kCoordinates)
    throw FormatError("its coordinates " + support::quoted(name) +
                          " are unknown to this program, which knows '" + kCoordinates + "'",
                      "use the program that wrote it, or make the file again");
}

/// What a message quotes must not move the cursor of a terminal.
void check_texts(const StoredTables& stored) {
  for (const auto& [name, attribute] : stored.attributes)
    if (const auto* text = std::get_if<std::string>(&attribute))
      if (const auto broken = check_text(name, *text)) throw FormatError(*broken, kRemake);
}

void check_version(const StoredTables& stored) {
  const int major = attribute<int>(stored, "format_major");
  const int minor = attribute<int>(stored, "format_minor");
  const std::string version = "format " + std::to_string(major) + "." + std::to_string(minor);
  if (major < kFormatMajor)
    throw FormatError(version + " is older than this program reads", "build the table again");
  if (major > kFormatMajor)
    throw FormatError(version + " is newer than this program reads",
                      "use a newer program, or build the table again with this one");
}

QuantileTable table_of(const StoredTables& stored, const std::string& name) {
  const Array& a = array(stored, name);
  const auto in_range = [](std::size_t n, std::size_t least) {
    return n >= least && n <= kMaxTableSide;
  };
  if (a.shape.size() != 2 || !in_range(a.shape[0], 2) || !in_range(a.shape[1], kFewestColumns))
    throw FormatError("the array '" + name + "' has the shape " + text_of(a.shape) +
                          ", not rows x columns, at least " + text_of({2, kFewestColumns}) +
                          " and at most " + text_of({kMaxTableSide, kMaxTableSide}),
                      kRemake);
  if (const auto* values = std::get_if<std::vector<double>>(&a.values))
    return QuantileTable::with_double_values(a.shape[0], a.shape[1], *values);
  return {a.shape[0], a.shape[1], values_of<std::vector<float>>(a, name)};
}

/// The values of an array of `columns` numbers a row, with its rows.
struct Rows {
  const std::vector<double>& values;
  std::size_t count;
};

Rows rows_of(const StoredTables& stored, const std::string& name, std::size_t columns,
             std::size_t least) {
  const Array& a = array(stored, name);
  if (a.shape.size() != 2 || a.shape[1] != columns || a.shape[0] < least ||
      a.shape[0] > kMaxCurveNodes)
    throw FormatError("the array '" + name + "' has the shape " + text_of(a.shape) +
                          ", not rows x " + std::to_string(columns) + " with " +
                          std::to_string(least) + " to " + std::to_string(kMaxCurveNodes) + " rows",
                      kRemake);
  return {values_of<std::vector<double>>(a, name), a.shape[0]};
}

std::vector<RowKnot> axis_of(const StoredTables& stored, const std::string& name) {
  const Rows rows = rows_of(stored, name, 2, 2);
  std::vector<RowKnot> knots;
  for (std::size_t i = 0; i < rows.count; ++i)
    knots.push_back({rows.values[2 * i], rows.values[2 * i + 1]});
  const bool identity = knots.size() == 2 && knots[0].base == 0 && knots[1].base == 1;
  return identity ? std::vector<RowKnot>{} : knots;
}

std::vector<CubicNode<double>> map_of(const StoredTables& stored, const std::string& name) {
  const Rows rows = rows_of(stored, name, 2, 2);
  std::vector<CubicNode<double>> nodes;
  for (std::size_t i = 0; i < rows.count; ++i)
    nodes.push_back({rows.values[2 * i], rows.values[2 * i + 1]});
  return nodes;
}

/// A whole number kept as float64, or a value that no check accepts.
std::size_t count_of(double value) {
  return value >= 0 && value <= static_cast<double>(kMaxCurveNodes)
             ? static_cast<std::size_t>(value)
             : kMaxCurveNodes + 1;
}

LogCurve<double> curve_of(const StoredTables& stored, const std::string& name, bool open) {
  const Rows nodes = rows_of(stored, name, 2, 2);
  const Rows segments = rows_of(stored, name + "_segments", kSegmentColumns, 1);
  std::vector<LogCurveSegment<double>> list;
  std::size_t next = 0;
  for (std::size_t i = 0; i < segments.count; ++i) {
    const double* s = segments.values.data() + kSegmentColumns * i;
    list.push_back(
        {s[0], s[1], static_cast<Grading>(std::min(count_of(s[2]), std::size_t{3})), {}});
    const std::size_t count = count_of(s[3]);
    if (count > nodes.count - next)
      throw FormatError(
          "the array '" + name + "_segments' counts more nodes than '" + name + "' has", kRemake);
    for (const std::size_t end = next + count; next < end; ++next)
      list.back().nodes.push_back({nodes.values[2 * next], nodes.values[2 * next + 1]});
  }
  if (next != nodes.count)
    throw FormatError(
        "the array '" + name + "_segments' counts fewer nodes than '" + name + "' has", kRemake);
  return {std::move(list), open};
}

SlopeTables tables_of(const StoredTables& stored) {
  const double support = attribute<double>(stored, "support");
  const bool open = std::isinf(support);
  return {.distribution = attribute<std::string>(stored, "distribution"),
          .mean_slope = attribute<double>(stored, "mean_slope"),
          .support = support,
          .conditional_constant = attribute<double>(stored, "conditional_constant"),
          .conditional_quadratic = attribute<double>(stored, "conditional_quadratic"),
          .marginal = table_of(stored, "marginal"),
          .conditional = table_of(stored, "conditional"),
          .marginal_rows = axis_of(stored, "marginal_rows"),
          .conditional_rows = axis_of(stored, "conditional_rows"),
          .marginal_map = map_of(stored, "marginal_map"),
          .log_ndf = curve_of(stored, "log_ndf", open),
          .log_backfacing = curve_of(stored, "log_backfacing", open)};
}

/// Only a profile has samples, and a file has no empty arrays.
Specification specification_of(const StoredTables& stored) {
  Specification specification{attribute<std::string>(stored, "specification")};
  if (!stored.arrays.contains(kSamples)) return specification;
  const Rows rows = rows_of(stored, kSamples, 2, 1);
  for (std::size_t i = 0; i < rows.count; ++i) {
    specification.r.push_back(rows.values[2 * i]);
    specification.p22.push_back(rows.values[2 * i + 1]);
  }
  return specification;
}

/// Only the tables of a map have a surface.
std::optional<SurfaceSlopes> surface_of(const StoredTables& stored) {
  if (!stored.attributes.contains(kSurface)) return {};
  const auto& text = attribute<std::string>(stored, kSurface);
  if (auto surface = surface_slopes_of(text)) return surface;
  throw FormatError("its attribute 'surface' " + support::quoted(text) +
                        " is not alpha_x, alpha_y (> 0), correlation (inside (-1, 1)), mean_x and "
                        "mean_y with a blank between them",
                    kRemake);
}

Provenance provenance_of(const StoredTables& stored) {
  return {.specification = specification_of(stored),
          .command = attribute<std::string>(stored, "command"),
          .program = attribute<std::string>(stored, "program"),
          .notes = attribute<std::string>(stored, "notes"),
          .surface = surface_of(stored)};
}

void check_content(const StoredTables& stored, const SlopeTables& tables,
                   const Specification& specification) {
  if (attribute<std::string>(stored, "content_checksum") !=
      hex_digits(content_checksum(tables, specification)))
    throw FormatError("it is damaged: its content does not match its attribute 'content_checksum'",
                      "copy it again, or build it again");
}

std::shared_ptr<const SlopeTables> checked(SlopeTables tables) {
  try {
    return share(std::move(tables));
  } catch (const std::invalid_argument& broken) {
    throw FormatError(std::string("it breaks a rule of ") + broken.what(),
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
  const bool like_curve = shape[0] <= kMaxCurveNodes && shape[1] <= kSegmentColumns;
  return like_table || like_curve;
}

void check_identity(const StoredTables& stored) {
  const auto type = stored.attributes.find("file_type");
  if (type == stored.attributes.end() || !std::holds_alternative<std::string>(type->second) ||
      std::get<std::string>(type->second) != kFileType)
    throw FormatError(std::string("its attribute 'file_type' is not '") + kFileType +
                          "', so another program wrote it",
                      "give a file written by vndf");
  check_version(stored);
  check_texts(stored);
  check_coordinates(stored);
}

StoredTables to_stored(const TableFile& file) {
  check_can_be_stored(file);
  const SlopeTables& tables = *file.tables;
  StoredTables result;
  result.attributes = {
      {"file_type", kFileType},
      {"format_major", kFormatMajor},
      {"format_minor", file.provenance.surface ? kFormatMinor : kMinorWithoutSurface},
      {"program", file.provenance.program},
      {"command", file.provenance.command},
      {"specification", file.provenance.specification.text},
      {"notes", file.provenance.notes},
      {"distribution", tables.distribution},
      {"coordinates", kCoordinates},
      {"mean_slope", tables.mean_slope},
      {"support", tables.support},
      {"conditional_constant", tables.conditional_constant},
      {"conditional_quadratic", tables.conditional_quadratic},
      {"content_checksum", hex_digits(content_checksum(tables, file.provenance.specification))}};
  if (const auto& surface = file.provenance.surface)
    result.attributes[kSurface] = text_of(*surface);
  for_each_figure(file.certificate, [&](const std::string& name, double value) {
    result.attributes[certificate_name(name)] = value;
  });
  result.arrays = {{"marginal", stored(tables.marginal)},
                   {"conditional", stored(tables.conditional)},
                   {"marginal_rows", stored(tables.marginal_rows)},
                   {"conditional_rows", stored(tables.conditional_rows)},
                   {"marginal_map", stored(tables.marginal_map)},
                   {"log_ndf", stored_nodes(tables.log_ndf)},
                   {"log_ndf_segments", stored_segments(tables.log_ndf)},
                   {"log_backfacing", stored_nodes(tables.log_backfacing)},
                   {"log_backfacing_segments", stored_segments(tables.log_backfacing)}};
  if (!file.provenance.specification.r.empty())
    result.arrays[kSamples] = stored(file.provenance.specification);
  return result;
}

std::string stored_checksum(const StoredTables& stored) {
  return hex_digits(content_checksum(tables_of(stored), specification_of(stored)));
}

TableFile from_stored(const StoredTables& stored) {
  check_identity(stored);
  SlopeTables tables = tables_of(stored);
  Provenance provenance = provenance_of(stored);
  check_content(stored, tables, provenance.specification);
  if (const auto broken = check(provenance)) throw FormatError(*broken, kRemake);
  return {.tables = checked(std::move(tables)),
          .provenance = std::move(provenance),
          .certificate = certificate_of(stored)};
}

}  // namespace vndf::io
