// Writes the JSON schemas of the programs' outputs and files: chainmail_schemas FOLDER
#include <filesystem>
#include <iostream>
#include <stdexcept>

#include "files/schema/schemas.h"
#include "files/text/outputs.h"

int main(int argc, char** argv) try {
  using namespace chainmail;
  const std::filesystem::path folder(argc == 2 ? argv[1] : throw std::invalid_argument("give a folder"));
  std::filesystem::create_directories(folder);
  for (const schema::Member& one : schema::joined({schema::schemas_of_results(), schema::schemas_of_files()})) {
    const std::string text = one.second.dump(2) + '\n';
    write_file(folder / (std::string(one.first) + ".schema.json"), [&](std::ostream& out) { out << text; });
  }
} catch (const std::exception& error) {
  std::cerr << "chainmail_schemas: " << error.what() << '\n';
  return 1;
}
