// Feeds the checksum piece by piece with a canonical byte sequence. Numbers are little-endian:
// 64-bit counts, float64, and the values of tables as they are stored.
#include "vndf/io/content_checksum.h"

#include <algorithm>
#include <array>
#include <bit>
#include <string_view>
#include <vector>

#include "vndf/io/crc64.h"
#include "vndf/io/table_format.h"

namespace vndf::io {
namespace {

template <class T>
void add_number(Crc64& crc, T value) {
  auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(value);
  if constexpr (std::endian::native == std::endian::big) std::ranges::reverse(bytes);
  crc.add({bytes.data(), bytes.size()});
}

void add_count(Crc64& crc, std::size_t count) {
  add_number(crc, static_cast<std::uint64_t>(count));
}

void add_text(Crc64& crc, std::string_view text) {
  add_count(crc, text.size());
  crc.add(text);
}

void add_table(Crc64& crc, const QuantileTable& table) {
  add_count(crc, table.rows());
  add_count(crc, table.columns());
  for (std::size_t i = 0; i < table.rows(); ++i)
    for (const double value : table.row_values(i))
      table.in_double() ? add_number(crc, value) : add_number(crc, static_cast<float>(value));
}

void add_axis(Crc64& crc, const std::vector<RowKnot>& knots) {
  add_count(crc, knots.size());
  for (const auto& knot : knots) {
    add_number(crc, knot.base);
    add_number(crc, knot.row);
  }
}

void add_map(Crc64& crc, const std::vector<CubicNode<double>>& nodes) {
  add_count(crc, nodes.size());
  for (const auto& node : nodes) {
    add_number(crc, node.value);
    add_number(crc, node.tangent);
  }
}

void add_curve(Crc64& crc, const LogCurve<double>& curve) {
  add_count(crc, curve.segments().size());
  for (const auto& segment : curve.segments()) {
    add_number(crc, segment.begin);
    add_number(crc, segment.end);
    add_count(crc, static_cast<std::size_t>(segment.grading));
    add_count(crc, segment.nodes.size());
    for (const auto& node : segment.nodes) {
      add_number(crc, node.value);
      add_number(crc, node.tangent);
    }
  }
}

void add_specification(Crc64& crc, const Specification& specification) {
  add_text(crc, specification.text);
  add_count(crc, specification.r.size());
  for (std::size_t i = 0; i < specification.r.size(); ++i) {
    add_number(crc, specification.r[i]);
    add_number(crc, specification.p22[i]);
  }
}

}  // namespace

std::uint64_t content_checksum(const SlopeTables& tables, const Specification& specification) {
  Crc64 crc;
  add_text(crc, kCoordinates);
  for (const double number : {tables.mean_slope, tables.support, tables.conditional_constant,
                              tables.conditional_quadratic})
    add_number(crc, number);
  add_table(crc, tables.marginal);
  add_table(crc, tables.conditional);
  add_axis(crc, tables.marginal_rows);
  add_axis(crc, tables.conditional_rows);
  add_map(crc, tables.marginal_map);
  add_curve(crc, tables.log_ndf);
  add_curve(crc, tables.log_backfacing);
  add_specification(crc, specification);
  return crc.value();
}

}  // namespace vndf::io
