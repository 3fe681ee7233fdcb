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
  std::string stem;  ///< its files of data are called STEM-PICTURE.exr
  validate::Verdict verdict;
  std::vector<Picture> pictures;
};

/// The name of the file with the data of a picture.
std::string data_file(const ReportSection& section, const Picture& picture);

/// What all samplers of the run have in common.
struct ReportedRun {
  std::string program;  ///< name and version
  std::string effort;   ///< the option that says how much is checked, with a space before, or empty
  std::uint64_t seed = 0;  ///< of its random numbers
};

/// The page as HTML, with its style and its pictures inside. It is readable on a narrow screen too.
std::string report_page(const ReportedRun& run, const std::vector<ReportSection>& sections);

}  // namespace vndf::tools
