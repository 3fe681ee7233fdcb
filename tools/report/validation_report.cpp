// The report of a run of validation.
#include "report/validation_report.h"

#include <algorithm>
#include <cctype>
#include <utility>

#include "report/gnuplot.h"

namespace vndf::tools {

ValidationReport::ValidationReport(const std::filesystem::path& folder, ReportedRun run)
    : folder_(folder), run_(std::move(run)) {
  require_gnuplot();
}

/// The name of the sampler without folders and extension, in letters that any system takes. A
/// number is added if the name is taken.
std::string ValidationReport::new_stem(const std::string& sampler) const {
  std::string stem = std::filesystem::path(sampler).stem().string();
  for (char& c : stem)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '.' && c != '_') c = '-';
  const auto taken = [this](const std::string& name) {
    return std::any_of(sections_.begin(), sections_.end(),
                       [&](const ReportSection& s) { return s.stem == name; });
  };
  std::string name = stem;
  for (int k = 2; taken(name); ++k) name = stem + "-" + std::to_string(k);
  return name;
}

void ValidationReport::add(const validate::SamplerUnderTest& sampler,
                           const validate::Verdict& verdict, const support::Workers& workers) {
  ReportSection section{sampler.name,
                        sampler.exact->unit_slopes().distribution().name(),
                        new_stem(sampler.name),
                        verdict,
                        {}};
  const PictureOptions options{run_.seed, workers, folder_.scratch()};
  for (const auto draw : {density_picture, error_picture, weight_picture, curve_picture})
    section.pictures.push_back(draw(sampler, options));
  for (Picture& picture : section.pictures) {
    if (picture.exr.empty()) continue;
    folder_.write(data_file(section, picture), picture.exr);
    picture.exr.clear();  // they are large
  }
  sections_.push_back(std::move(section));
}

void ValidationReport::finish() {
  folder_.write("index.html", report_page(run_, sections_));
  folder_.put_in_place();
}

}  // namespace vndf::tools
