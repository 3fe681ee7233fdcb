// vndf convert: the same tables in the other format.
#include <memory>
#include <string>

#include "commands.h"
#include "io/table_file.h"
#include "output_file.h"

namespace vndf::tools {

void add_convert(CLI::App& app) {
  struct Arguments {
    std::string input, output;
  };
  auto* command = app.add_subcommand("convert", "Copy tables to another format, bit for bit");
  const auto arguments = std::make_shared<Arguments>();
  command->add_option("input", arguments->input, "Table file to read")->required();
  command->add_option("output", arguments->output, "Table file to write: .h5 or .exr")->required();
  command->callback([arguments] {
    io::format_for(arguments->output);
    require_output(arguments->output);
    io::save(arguments->output, io::load(arguments->input));
  });
}

}  // namespace vndf::tools
