// vndf info: what a table file holds and how accurate it is.
#include <iostream>
#include <memory>
#include <string>

#include "commands/commands.h"
#include "commands/output_file.h"
#include "commands/table_files.h"
#include "report/report.h"

namespace vndf::tools {

void add_info(CLI::App& app) {
  struct Arguments {
    std::string file;
    bool json = false;
  };
  auto* command = app.add_subcommand(
      "info",
      "Show what a table file holds and its certificate\n\n"
      "The certificate has the errors that were measured when the tables were made.");
  const auto arguments = std::make_shared<Arguments>();
  command->add_option("file", arguments->file, "Table file")->required();
  command->add_flag("--json", arguments->json, "Print one JSON object");
  command->callback([arguments] {
    const auto print = [&](const auto& tables) {
      if (arguments->json)
        std::cout << json_text(to_json(tables)) << '\n';
      else
        std::cout << describe(tables);
    };
    std::visit(print, load_tables(arguments->file));
  });
}

}  // namespace vndf::tools
