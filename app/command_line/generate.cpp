#include "mesh/generate.h"

#include <algorithm>

#include "command_line/common.h"

namespace chainmail::command_line {
namespace {

struct GenerateArguments {
  CLI::Option *kind, *size, *spacing, *space, *output;
};

std::string size_form(int sizes) { return sizes == 1 ? "N" : sizes == 2 ? "WxH" : "WxHxD"; }

Choices<const MeshKindInfo*> kinds() {
  Choices<const MeshKindInfo*> all;
  for (const MeshKindInfo& one : mesh_kinds()) {
    all.emplace_back(one.name, &one);
  }
  return all;
}

std::string kinds_help() {
  std::string text = "kind of mesh:";
  for (const MeshKindInfo& one : mesh_kinds()) {
    text += "\n" + std::string(one.name) + " " + size_form(one.sizes) + ", " + std::string(one.help);
  }
  return text;
}

std::array<std::uint32_t, 3> size_of(const GenerateArguments& options, const MeshKindInfo& kind) {
  const std::string text = *value_of(options.size);
  const auto size = parse_size(text, kind.sizes);
  if (!size) {
    throw Error("SIZE", in_quotes(text) + " is not the size of a " + std::string(kind.name),
                "write " + size_form(kind.sizes) + " with whole numbers from 1");
  }
  return *size;
}

void generate_to_file(const GenerateArguments& options) {
  const MeshKindInfo& kind = *choice_of<const MeshKindInfo*>(options.kind, kinds(), nullptr);
  const MeshRecipe recipe{kind.kind, size_of(options, kind), value_of(options.spacing, parameters::spacing),
                          choice_of(options.space, spaces, {})};
  const std::string path = *value_of(options.output), named = path == "-" ? "standard_output.dat" : path;
  const MeshFormat& format = mesh_format(named, FormatUse::write);
  const MeshPointer mesh = in_options({{"size", "SIZE"}, {"spacing", "--spacing"}, {"space dimension", "--space"}},
                                      [&] { return generate(recipe); });
  check_holds(format, *mesh, named);
  write_file(path, [&](std::ostream& out) { write_mesh(out, format, *mesh, {}); });
}

}  // namespace

Command add_generate(CLI::App& root) {
  CLI::App* app = root.add_subcommand("generate", "Generate a regular mesh");
  GenerateArguments options{};
  options.kind = add_choice(*app, "KIND", kinds(), kinds_help())->required();
  options.size = add_value(*app, "SIZE", "", "number of elements along each axis")->required();
  options.spacing = add_parameter(*app, parameters::spacing);
  options.space =
      add_choice(*app, "--space", spaces, "number of coordinates [the number of axes along which the mesh extends]");
  options.output = add_value(*app, "-o", "FILE",
                             "output file: " + mesh_endings(FormatUse::write) + "; - writes .dat to standard output")
                       ->required();
  app->footer("Formats:\n" + mesh_formats_help(FormatUse::write) +
              "\nExample:\n  chainmail generate cloth 24x16 --spacing 0.5 -o cloth.obj");
  return {app, [options] { generate_to_file(options); }};
}

}  // namespace chainmail::command_line
