// Bakes the pair of a file.
#include "commands/bake_pair.h"

#include <fmt/format.h>

#include <exception>
#include <memory>

#include "commands/commands.h"
#include "commands/messages.h"
#include "commands/progress.h"
#include "commands/table_files.h"
#include "vndf/precompute/bake_certified.h"

namespace vndf::tools {

KernelTables bake_pair(const std::string& path, const io::TableFile& pair,
                       const BakeArguments& arguments, const BakeRun& run) {
  const BakeOptions options = options_of(arguments);
  KernelText text{pair.tables->distribution, pair.provenance};
  text.provenance.command += "\n" + run.command_line;
  text.provenance.program = kProgram;
  std::unique_ptr<distributions::SlopeDistribution> distribution;
  try {
    distribution = distribution_of(path, pair);
  } catch (const std::exception& e) {
    const std::string note = fmt::format(
        "certificate: that of the pair and the differences from it, not measured, for {}",
        e.what());
    print_warning(note);
    text.provenance.notes += note + "\n";
    return precompute::bake_uncertified(*pair.tables, pair.certificate, options, text);
  }
  Progress progress(run.show_progress);
  progress.begin("baking");
  const support::Workers workers = progress.workers(run.threads);
  return precompute::bake_certified(precompute::UnitSlopes(*distribution, workers), *pair.tables,
                                    options, text, workers);
}

}  // namespace vndf::tools
