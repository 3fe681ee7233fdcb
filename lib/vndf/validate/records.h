// Samples of somebody's sampler as text, one a line, under the header
//
//   wx,wy,wz,ax,ay,u1,u2,mx,my,mz       incident direction, roughness, random numbers, normal
//
// u1,u2 may be missing, and a column pdf may follow. Blank lines and lines that start with '#' are
// skipped.
#pragma once

#include <filesystem>
#include <istream>
#include <string>
#include <vector>

#include "vndf/validate/exact/configuration.h"

namespace vndf::validate {

/// How far the length of a direction may be from 1: of text with few digits.
inline constexpr double kLengthSlack = 1e-3;

struct Record {
  Configuration configuration;
  Vec3<double> wm;
  double u1 = kUnknown, u2 = kUnknown, pdf = kUnknown;
};

struct Records {
  std::vector<Record> list;
  bool has_u = false, has_pdf = false;
};

/// Reads records. Throws std::runtime_error, naming the file, the line and the rule that it breaks.
Records read_records(const std::filesystem::path& path);

/// The same from a stream; `name` stands for the file in messages.
Records read_records(std::istream& stream, const std::string& name);

}  // namespace vndf::validate
