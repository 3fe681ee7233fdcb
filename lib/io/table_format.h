// What a table file of this version is called and may hold. tables/FORMAT.md describes the format
// for readers in any language.
#pragma once

#include <cstddef>
#include <cstdint>

namespace vndf::io {

/// A reader refuses any other major version. A newer minor version adds attributes and arrays,
/// which an older reader ignores, or names of coordinates, which it refuses.
inline constexpr int kFormatMajor = 1, kFormatMinor = 1;

/// Value of the attribute `file_type`.
inline constexpr char kFileType[] = "vndf slope tables";
/// Names of the axes and values of table_coordinates.h: fixed ones and, since version 1.1, those
/// adapted to the distribution: a map for the values of the marginal, scale and unit of the
/// conditional, a conditional of one row, tables in double precision.
inline constexpr char kCoordinates[] = "bounded-slope-1";
inline constexpr char kAdaptedCoordinates[] = "adapted-slope-1";
/// Names of the interpolation of table.h; by the blend of the rows of the marginal and of the
/// conditional.
inline constexpr const char* kInterpolations[2][2] = {
    {"linear rows, monotone cubic columns",
     "linear rows in marginal, cubic in conditional, monotone cubic columns"},
    {"cubic rows in marginal, linear in conditional, monotone cubic columns",
     "cubic rows, monotone cubic columns"}};

/// Limits that a reader checks before it allocates, and a writer so that every file can be read.
inline constexpr std::size_t kMaxTableSide = 8192;         ///< rows or columns of a table
inline constexpr std::size_t kMaxCurveNodes = 1u << 20;    ///< nodes of a curve or knots of an axis
inline constexpr std::uintmax_t kMaxFileBytes = 1u << 30;  ///< whole file
inline constexpr std::size_t kMaxTextBytes = 60000;  ///< one text; HDF5 holds just under 64 KiB

}  // namespace vndf::io
