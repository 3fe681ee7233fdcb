// The report of a run of validation: a page with pictures and their data, one section a sampler.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "report/report_page.h"
#include "vndf/io/atomic_folder.h"

namespace vndf::tools {

/// Collects the samplers of a run and writes the report when it is finished.
class ValidationReport {
 public:
  /// Throws std::runtime_error, before any work, if gnuplot is missing or `folder` cannot be made
  /// or replaced (io::AtomicFolder).
  ValidationReport(const std::filesystem::path& folder, ReportedRun run);

  /// Draws the pictures of a sampler, which takes some seconds, and keeps them with its verdict.
  void add(const validate::SamplerUnderTest& sampler, const validate::Verdict& verdict,
           const support::Workers& workers);

  /// Writes the page and moves the whole folder to its place.
  void finish();

 private:
  std::string new_stem(const std::string& sampler) const;

  io::AtomicFolder folder_;
  ReportedRun run_;
  std::vector<ReportSection> sections_;
};

}  // namespace vndf::tools
