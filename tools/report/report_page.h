// The page of a report of validation: one HTML text that needs no other file to be read.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "report/report_pictures.h"
#include "vndf/validate/validate.h"

namespace vndf::tools {

/// One sampler of a report.
struct ReportSection {
  std::string sampler, distribution;
  std::string stem;  ///< of the names of its files of data: STEM-PICTURE.exr
  validate::Verdict verdict;
  std::vector<Picture> pictures;
};

/// The name of the file with the data of a picture.
std::string data_file(const ReportSection& section, const Picture& picture);

/// What the whole run had in common.
struct ReportedRun {
  std::string program, effort;
  std::uint64_t seed = 0;
};

/// HTML with its style and its pictures inside.
std::string report_page(const ReportedRun& run, const std::vector<ReportSection>& sections);

}  // namespace vndf::tools
