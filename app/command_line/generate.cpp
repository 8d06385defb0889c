#include "mesh/generate.h"

#include "command_line/common.h"
#include "files/text/outputs.h"
#include "files/text/text.h"
#include "mesh/error.h"

namespace chainmail::command_line {
namespace {

struct GenerateArguments {
  CLI::Option *kind, *size, *spacing, *space, *output;
};

std::string size_form(int sizes) { return sizes == 1 ? "N" : sizes == 2 ? "WxH" : "WxHxD"; }

std::string kind_names() {
  std::string names;
  for (const MeshKindInfo& info : mesh_kinds()) {
    names += (names.empty() ? "" : "|") + std::string(info.name);
  }
  return names;
}

std::string kinds_help() {
  std::string text = "kind of mesh:";
  for (const MeshKindInfo& info : mesh_kinds()) {
    text += "\n" + std::string(info.name) + " " + size_form(info.sizes) + ", " + std::string(info.help);
  }
  return text;
}

const MeshKindInfo& find_kind(const std::string& name) {
  std::vector<std::string> names;
  for (const MeshKindInfo& info : mesh_kinds()) {
    if (info.name == name) {
      return info;
    }
    names.emplace_back(info.name);
  }
  check_word("KIND", name, names);
  throw Error("KIND", "it is not known", "see chainmail generate --help");
}

MeshRecipe read_recipe(const GenerateArguments& options) {
  const std::string kind = *value_of(options.kind);
  const MeshKindInfo& info = find_kind(kind);
  MeshRecipe recipe;
  recipe.kind = info.kind;
  const std::string text = *value_of(options.size);
  const auto size = parse_size(text, info.sizes);
  if (!size) {
    throw Error("SIZE", in_quotes(text) + " is not the size of a " + std::string(info.name),
                "write " + size_form(info.sizes) + " with whole numbers from 1");
  }
  recipe.size = *size;
  recipe.spacing = value_of(options.spacing, parameters::spacing);
  recipe.space_dimension = space_of(options.space);
  return recipe;
}

void generate_to_file(const GenerateArguments& options) {
  const MeshRecipe recipe = read_recipe(options);
  const std::filesystem::path path = *value_of(options.output);
  const std::filesystem::path named = path == "-" ? "standard_output.dat" : path;
  const MeshFormat& format = mesh_format(named, FormatUse::write);
  const MeshPointer mesh = in_options({{"size", "SIZE"}, {"spacing", "--spacing"}, {"space dimension", "--space"}},
                                      [&] { return generate(recipe); });
  check_holds(format, *mesh, path);
  write_file(path, [&](std::ostream& out) { write_mesh(out, format, {*mesh, {}, rest_positions(*mesh), {}}); });
}

}  // namespace

Command add_generate(CLI::App& root) {
  CLI::App* app = root.add_subcommand("generate", "Generate a regular mesh");
  GenerateArguments options{};
  options.kind = add_value(*app, "KIND", kind_names(), kinds_help())->required();
  options.size = add_value(*app, "SIZE", "", "number of elements along each axis")->required();
  options.spacing = add_parameter(*app, parameters::spacing);
  options.space =
      add_value(*app, "--space", "1|2|3", "number of coordinates [the number of axes along which the mesh extends]");
  options.output = add_value(*app, "-o", "FILE",
                             "output file: " + mesh_endings(FormatUse::write) + "; - writes .dat to standard output")
                       ->required();
  app->footer("Formats:\n" + mesh_formats_help(FormatUse::write) +
              "\nExample:\n  chainmail generate cloth 24x16 --spacing 0.5 -o cloth.obj");
  return {app, [options] { generate_to_file(options); }};
}

}  // namespace chainmail::command_line
