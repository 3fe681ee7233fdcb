// The lists of names.
#include "vndf/io/stored_names.h"

#include "vndf/certificate.h"

namespace vndf::io {

std::string certificate_name(const std::string& figure) {
  return "certificate_" + figure;
}

const std::vector<std::string>& attribute_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list{"file_type",
                                  "format_major",
                                  "format_minor",
                                  "program",
                                  "command",
                                  "specification",
                                  "notes",
                                  kSurface,
                                  "distribution",
                                  "coordinates",
                                  "mean_slope",
                                  "support",
                                  "conditional_constant",
                                  "conditional_quadratic",
                                  "content_checksum"};
    const Certificate certificate;
    for_each_figure(certificate, [&](const std::string& figure, double) {
      list.push_back(certificate_name(figure));
    });
    return list;
  }();
  return names;
}

const std::vector<std::string>& array_names() {
  static const std::vector<std::string> names{
      "marginal", "conditional",      "marginal_rows",  "conditional_rows",        "marginal_map",
      "log_ndf",  "log_ndf_segments", "log_backfacing", "log_backfacing_segments", kSamples};
  return names;
}

}  // namespace vndf::io
