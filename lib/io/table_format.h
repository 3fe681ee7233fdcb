// What a table file of this version is called and may hold. tables/FORMAT.md describes the format
// for readers in any language.
#pragma once

#include <cstddef>
#include <cstdint>

#include "vndf/table.h"

namespace vndf::io {

/// A reader refuses any other major version. A newer minor version adds attributes and arrays,
/// which an older reader ignores, or names of coordinates or interpolation, which it refuses.
inline constexpr int kFormatMajor = 1, kFormatMinor = 2;

/// Value of the attribute `file_type`.
inline constexpr char kFileType[] = "vndf slope tables";
/// Names of the axes and values of table_coordinates.h: fixed ones and, since version 1.1, those
/// adapted to the distribution: a map for the values of the marginal, scale and unit of the
/// conditional, a conditional of one row, tables in double precision.
inline constexpr char kCoordinates[] = "bounded-slope-1";
inline constexpr char kAdaptedCoordinates[] = "adapted-slope-1";

/// The interpolation of table.h under its name: how the rows of the marginal and of the conditional
/// are blended, and how the marginal takes its tangents; by five points since version 1.2.
struct Interpolation {
  const char* name;
  RowBlend marginal, conditional;
  Tangents tangents;
};
inline constexpr Interpolation kInterpolations[] = {
    {"linear rows, monotone cubic columns", RowBlend::linear, RowBlend::linear,
     Tangents::three_points},
    {"linear rows in marginal, cubic in conditional, monotone cubic columns", RowBlend::linear,
     RowBlend::cubic, Tangents::three_points},
    {"cubic rows in marginal, linear in conditional, monotone cubic columns", RowBlend::cubic,
     RowBlend::linear, Tangents::three_points},
    {"cubic rows, monotone cubic columns", RowBlend::cubic, RowBlend::cubic,
     Tangents::three_points},
    {"linear rows, monotone cubic columns by five points", RowBlend::linear, RowBlend::linear,
     Tangents::five_points},
    {"linear rows in marginal, cubic in conditional, monotone cubic columns by five points",
     RowBlend::linear, RowBlend::cubic, Tangents::five_points},
    {"cubic rows in marginal, linear in conditional, monotone cubic columns by five points",
     RowBlend::cubic, RowBlend::linear, Tangents::five_points},
    {"cubic rows, monotone cubic columns by five points", RowBlend::cubic, RowBlend::cubic,
     Tangents::five_points}};

/// Limits that a reader checks before it allocates, and a writer so that every file can be read.
inline constexpr std::size_t kMaxTableSide = 8192;         ///< rows or columns of a table
inline constexpr std::size_t kMaxCurveNodes = 1u << 20;    ///< nodes of a curve or knots of an axis
inline constexpr std::uintmax_t kMaxFileBytes = 1u << 30;  ///< whole file
inline constexpr std::size_t kMaxTextBytes = 60000;  ///< one text; HDF5 holds just under 64 KiB

}  // namespace vndf::io
