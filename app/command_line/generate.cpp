#include <algorithm>

#include "chainmail/mesh.h"
#include "command_line/common.h"

namespace chainmail::command_line {
namespace {

struct GenerateArguments {
  CLI::Option *kind, *size, *spacing, *space, *output;
};

std::string size_form(int sizes) { return sizes == 1 ? "N" : sizes == 2 ? "WxH" : "WxHxD"; }

std::string kind_names() {
  std::string names;
  for (const api::MeshKind& info : api::mesh_kinds()) {
    names += (names.empty() ? "" : "|") + std::string(info.name);
  }
  return names;
}

std::string kinds_help() {
  std::string text = "kind of mesh:";
  for (const api::MeshKind& info : api::mesh_kinds()) {
    text += "\n" + std::string(info.name) + " " + size_form(info.sizes) + ", " + std::string(info.help);
  }
  return text;
}

const api::MeshKind& find_kind(const std::string& name) {
  std::vector<std::string> names;
  for (const api::MeshKind& info : api::mesh_kinds()) {
    names.emplace_back(info.name);
  }
  check_word("KIND", name, names);
  return *std::ranges::find(api::mesh_kinds(), name, &api::MeshKind::name);
}

std::array<std::uint32_t, 3> size_of(const GenerateArguments& options, const api::MeshKind& kind) {
  const std::string text = *value_of(options.size);
  const auto size = api::parse_size(text, kind.sizes);
  if (!size) {
    throw api::Error("SIZE", api::in_quotes(text) + " is not the size of a " + std::string(kind.name),
                     "write " + size_form(kind.sizes) + " with whole numbers from 1");
  }
  return *size;
}

void generate_to_file(const GenerateArguments& options) {
  const api::MeshKind& kind = find_kind(*value_of(options.kind));
  const auto size = size_of(options, kind);
  const api::LatticeOptions how{value_of(options.spacing, api::parameter("spacing")), space_of(options.space)};
  const std::string path = *value_of(options.output), named = path == "-" ? "standard_output.dat" : path;
  api::check_format(named, api::FileUse::write);
  const api::Mesh mesh = in_options({{"size", "SIZE"}, {"spacing", "--spacing"}, {"space dimension", "--space"}},
                                    [&] { return api::make_lattice(kind.name, size, how); });
  api::check_format(named, mesh);
  api::write_file(path, [&](std::ostream& out) { api::write_mesh(out, named, mesh); });
}

}  // namespace

Command add_generate(CLI::App& root) {
  CLI::App* app = root.add_subcommand("generate", "Generate a regular mesh");
  GenerateArguments options{};
  options.kind = add_value(*app, "KIND", kind_names(), kinds_help())->required();
  options.size = add_value(*app, "SIZE", "", "number of elements along each axis")->required();
  options.spacing = add_parameter(*app, api::parameter("spacing"));
  options.space =
      add_value(*app, "--space", "1|2|3", "number of coordinates [the number of axes along which the mesh extends]");
  options.output =
      add_value(*app, "-o", "FILE",
                "output file: " + api::file_endings(api::FileUse::write) + "; - writes .dat to standard output")
          ->required();
  app->footer("Formats:\n" + api::file_formats_help(api::FileUse::write) +
              "\nExample:\n  chainmail generate cloth 24x16 --spacing 0.5 -o cloth.obj");
  return {app, [options] { generate_to_file(options); }};
}

}  // namespace chainmail::command_line
