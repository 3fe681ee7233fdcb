// What a table file of this version is called and may hold. tables/FORMAT.md describes the format
// for readers in any language.
#pragma once

#include <cstddef>
#include <cstdint>

namespace vndf::io {

/// A reader refuses any other major version. A newer minor version adds attributes and arrays,
/// which an older reader ignores, or a name of coordinates, which it refuses.
inline constexpr int kFormatMajor = 4, kFormatMinor = 1;
/// The minor version that a file without a surface has, because it holds nothing newer.
inline constexpr int kMinorWithoutSurface = 0;

/// Value of the attribute `file_type`.
inline constexpr char kFileType[] = "vndf slope tables";
/// Name of the axes and values of table_coordinates.h and of the interpolation of table.h.
inline constexpr char kCoordinates[] = "bounded-slope-3";

/// Limits that a reader checks before it allocates, and a writer so that every file can be read.
inline constexpr std::size_t kMaxTableSide = 16384;        ///< rows or columns of a table
inline constexpr std::size_t kMaxCurveNodes = 1u << 20;    ///< nodes of a curve or knots of an axis
inline constexpr std::uintmax_t kMaxFileBytes = 1u << 30;  ///< whole file

}  // namespace vndf::io
