#include "mesh/generate.h"

#include "command_line/common.h"

namespace chainmail::command_line {
namespace {

std::string size_form(int sizes) { return sizes == 1 ? "N" : sizes == 2 ? "WxH" : "WxHxD"; }

std::string kinds_help() {
  std::string text = "kind of mesh:";
  for (const MeshKindInfo& one : mesh_kinds()) {
    text += "\n" + std::string(one.name) + " " + size_form(one.sizes) + ", " + std::string(one.help);
  }
  return text;
}

/// The kind and the size, whose form depends on the kind, and the rest of the recipe.
struct GenerateArguments {
  Options options;
  const MeshKindInfo* kind = nullptr;
  CLI::Option *size = nullptr, *output = nullptr;
  MeshRecipe recipe = {};
};

void read_kind_and_size(GenerateArguments& arguments) {
  arguments.options.read();
  const std::string text = *value_of(arguments.size);
  const auto size = parse_size(text, arguments.kind->sizes);
  require(size.has_value(), "SIZE", in_quotes(text) + " is not the size of a " + std::string(arguments.kind->name),
          "write " + size_form(arguments.kind->sizes) + " with whole numbers from 1");
  arguments.recipe.kind = arguments.kind->kind;
  arguments.recipe.size = *size;
}

void generate_to_file(GenerateArguments& arguments) {
  read_kind_and_size(arguments);
  const std::string path = *value_of(arguments.output), named = path == "-" ? "standard_output.dat" : path;
  const MeshFormat& format = mesh_format(named, FormatUse::write);
  check_outputs({}, {path});
  const MeshPointer mesh =
      watched("generating a mesh", {{"size", "SIZE"}, {"spacing", "--spacing"}, {"space dimension", "--space"}},
              [&](const Progress& progress) { return generate(arguments.recipe, progress); });
  check_holds(format, *mesh, named);
  write_file(path, [&](std::ostream& out) { write_mesh(out, format, *mesh, {}); });
}

}  // namespace

Command add_generate(CLI::App& root) {
  CLI::App* app = root.add_subcommand("generate", "Generate a regular mesh");
  const auto arguments = std::make_shared<GenerateArguments>(GenerateArguments{Options(*app)});
  Options& options = arguments->options;
  options
      .add("KIND", choices_of(mesh_kinds(), [](const MeshKindInfo& one) { return &one; }), kinds_help(),
           arguments->kind)
      ->required();
  arguments->size = add_value(*app, "SIZE", "", "number of elements along each axis")->required();
  options.add(parameters::spacing, arguments->recipe.spacing);
  options.add("--space", spaces, "number of coordinates [the number of axes along which the mesh extends]",
              arguments->recipe.space_dimension);
  arguments->output = add_value(*app, "-o", "FILE",
                                "output file: " + mesh_endings(FormatUse::write) + "; - writes .dat to standard output")
                          ->required();
  app->footer("Formats:\n" + mesh_formats_help(FormatUse::write) +
              "\nExample:\n  chainmail generate cloth 24x16 --spacing 0.5 -o cloth.obj");
  return {app, [arguments] { generate_to_file(*arguments); }};
}

}  // namespace chainmail::command_line
