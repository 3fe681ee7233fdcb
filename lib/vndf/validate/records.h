// Samples of somebody's sampler as text, one a line, so that a sampler in any language can be
// validated. The header is
//
//   wx,wy,wz,ax,ay,u1,u2,mx,my,mz       incident direction, roughness, random numbers, normal
//
// where u1,u2 may be missing and a column pdf may follow. Blank lines and lines that start with '#'
// are skipped.
#pragma once

#include <filesystem>
#include <istream>
#include <string>
#include <vector>

#include "vndf/validate/exact/configuration.h"

namespace vndf::validate {

/// How far the length of a direction may be from 1, because text may have few digits.
inline constexpr double kLengthSlack = 1e-3;

/// One sample. Random numbers and density are kUnknown where they are not given.
struct Record {
  Configuration configuration;
  Vec3<double> wm;
  double u1 = kUnknown, u2 = kUnknown, pdf = kUnknown;
};

/// Samples, and which of the columns that may be missing they have.
struct Records {
  std::vector<Record> list;
  bool has_u = false, has_pdf = false;
};

/// Reads records from a file. Throws std::runtime_error, which names the file, the line and the
/// rule that it breaks.
Records read_records(const std::filesystem::path& path);

/// Reads records from a stream; `name` stands for the file in messages.
Records read_records(std::istream& stream, const std::string& name);

}  // namespace vndf::validate
