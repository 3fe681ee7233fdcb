// The report of a run of validation.
#include "report/validation_report.h"

#include <algorithm>
#include <cctype>
#include <utility>

#include "report/gnuplot.h"

namespace vndf::tools {

ValidationReport::ValidationReport(const std::filesystem::path& folder,
                                   ReportCircumstances circumstances)
    : folder_(folder), circumstances_(std::move(circumstances)) {
  require_gnuplot();
}

/// The name of the subject without folders and extension, of letters that any system takes, with a
/// number behind it if the name is taken.
std::string ValidationReport::new_stem(const std::string& subject) const {
  std::string stem = std::filesystem::path(subject).stem().string();
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

void ValidationReport::add(const validate::Subject& subject, const validate::Verdict& verdict,
                           const support::Workers& workers) {
  ReportSection section{subject.name,
                        subject.law->slopes().distribution().name(),
                        new_stem(subject.name),
                        verdict,
                        {}};
  const PictureOptions options{circumstances_.seed, workers, folder_.scratch()};
  for (const auto draw : {density_picture, error_picture, weight_picture, curve_picture})
    section.pictures.push_back(draw(subject, options));
  for (Picture& picture : section.pictures) {
    if (picture.exr.empty()) continue;
    folder_.write(data_file(section, picture), picture.exr);
    picture.exr.clear();  // they are large
  }
  sections_.push_back(std::move(section));
}

void ValidationReport::finish() {
  folder_.write("index.html", report_page(circumstances_, sections_));
  folder_.put_in_place();
}

}  // namespace vndf::tools
