// Samples of somebody's sampler as text, one a line, so that a sampler in any language can be
// validated. The header is
//
//   wx,wy,wz,ax,ay,u1,u2,mx,my,mz       incident direction, roughness, random numbers, normal
//
// where u1,u2 may be missing and a column pdf may follow. A surface that is not flat has
// correlation,mean_x,mean_y after ay, all three (SurfaceSlopes). Blank lines and lines that start
// with '#' are skipped. Every line is read and must be right, but of a very long file only a random
// part is kept, so that its length does not decide how much memory is taken.
#pragma once

#include <filesystem>
#include <istream>
#include <optional>
#include <string>
#include <vector>

#include "vndf/validate/exact/configuration.h"

namespace vndf::validate {

/// How far the length of a direction may be from 1, because text may have few digits.
inline constexpr double kLengthSlack = 1e-3;

/// The range of roughness. Beyond it slopes leave the range of single precision.
inline constexpr double kSmallestRoughness = 1e-9, kLargestRoughness = 1e9;
/// The most records that are kept: they take 176 MB, and show errors of 4e-3 in u.
inline constexpr std::size_t kMostRecords = 2000000;

/// One sample. Random numbers and density are kUnknown where they are not given.
struct Record {
  Configuration configuration;
  Vec3<double> wm;
  double u1 = kUnknown, u2 = kUnknown, pdf = kUnknown;
};

/// The largest mean slope, either way, along x and y.
inline constexpr double kLargestMeanSlope = 1e9;

/// Samples, and which of the columns that may be missing they have.
struct Records {
  std::vector<Record> list;
  bool has_u = false, has_pdf = false;
  std::size_t read = 0;  ///< how many the file has; list holds them all, or a random part of them
};

/// The first rule that `record` breaks, for a message, or nothing: directions of length 1, roughness,
/// correlation and mean slopes within their limits and, unless kUnknown, random numbers in [0, 1].
std::optional<std::string> broken_rule(const Record& record);

/// Reads records from a file. Of more than kMostRecords it keeps that many, each with the same
/// probability, in an order that is not that of the file (Vitter 1985, algorithm R); the choice is
/// always the same for one file. Throws std::runtime_error, which names the file, the line and the
/// rule that it breaks.
Records read_records(const std::filesystem::path& path);

/// Reads records from a stream, of which it keeps `most`; `name` stands for the file in messages.
Records read_records(std::istream& stream, const std::string& name,
                     std::size_t most = kMostRecords);

}  // namespace vndf::validate
