#include "command_line/common.h"

#include <algorithm>
#include <iostream>

#include "command_line/progress_line.h"

namespace chainmail::command_line {
namespace {

std::string name_of(const Parameter& parameter) { return "--" + std::string(parameter.name); }

VoxelOptions voxels_of(const MeshOptions& options) {
  VoxelOptions voxels;
  if (options.threshold->count() > 0) {
    voxels.threshold = number_of(options.threshold, 0);
  }
  if (options.voxels->count() > 0) {
    voxels.every = whole_number_of(options.voxels, 1, 1);
  }
  voxels.stiff_where_dense = choice_of(options.by_density, on_or_off, true);
  return voxels;
}

ReadOptions read_options_of(const MeshOptions& options) {
  ReadOptions how;
  if (const auto size = value_of(options.size)) {
    how.size = parse_size(*size);
    if (!how.size) {
      throw Error("--size", in_quotes(*size) + " is not a size", "write WxH or WxHxD with whole numbers from 1");
    }
  }
  if (const double spacing = value_of(options.spacing, parameters::spacing); options.spacing->count() > 0) {
    how.spacing = spacing;
  }
  how.space_dimension = choice_of(options.space, spaces, {});
  how.voxels = voxels_of(options);
  how.data_outside = choice_of(options.data_outside, {{"allow", true}, {"refuse", false}}, false);
  if (const auto tolerance = value_of(options.weld)) {
    how.weld = tolerance_of(*tolerance);
  }
  return how;
}

}  // namespace

CLI::Option* add_value(CLI::App& app, const std::string& name, const std::string& type, const std::string& help) {
  return app.add_option(name, help)
      ->type_name(type)
      ->expected(1)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

std::string help_of(const Parameter& parameter) {
  std::string help = std::string(parameter.help) + " [";
  append_number(help, parameter.default_value);
  return help + "]";
}

CLI::Option* add_parameter(CLI::App& app, const Parameter& parameter) {
  return add_value(app, name_of(parameter), "NUMBER", help_of(parameter));
}

std::optional<std::string> value_of(const CLI::Option* option) {
  if (option == nullptr || option->results().empty()) {
    return std::nullopt;
  }
  const auto& values = option->results();
  if (values.size() > 1) {
    throw Error(option->get_name(), "it was given " + std::to_string(values.size()) + " times", "use it once");
  }
  return values.front();
}

double parse_number_of(const std::string& where, std::string_view text) {
  const auto number = parse_number(text);
  if (!number) {
    throw Error(where, in_quotes(text) + " is not a finite number", "write a decimal number like 0.5 or -2e3");
  }
  return *number;
}

double number_of(const CLI::Option* option, double default_value) {
  const auto text = value_of(option);
  return text ? parse_number_of(option->get_name(), *text) : default_value;
}

double value_of(const CLI::Option* option, const Parameter& parameter) {
  const double number = number_of(option, parameter.default_value);
  in_options({{std::string(parameter.name), name_of(parameter)}}, [&] { check(parameter, number); });
  return number;
}

std::uint32_t whole_number_of(const CLI::Option* option, std::uint32_t lowest, std::uint32_t default_value,
                              std::uint32_t highest) {
  const auto text = value_of(option);
  if (!text) {
    return default_value;
  }
  const auto number = parse_count(*text);
  if (!number || *number < lowest || *number > highest) {
    throw Error(option->get_name(), in_quotes(*text) + " is not a whole number in range",
                "use " + std::to_string(lowest) + " to " + std::to_string(highest));
  }
  return *number;
}

std::vector<std::string_view> split(std::string_view text, char mark) {
  std::vector<std::string_view> parts;
  for (std::size_t begin = 0; begin <= text.size(); begin += parts.back().size() + 1) {
    parts.push_back(text.substr(begin, text.find(mark, begin) - begin));
  }
  return parts;
}

std::vector<std::string> words_of(const std::string& where, const std::string& list) {
  std::vector<std::string> words;
  for (const std::string_view word : split(list)) {
    if (std::ranges::find(words, word) != words.end()) {
      throw Error(where, in_quotes(word) + " is given twice", "write each one once");
    }
    words.emplace_back(word);
  }
  return words;
}

void check_word(const std::string& where, const std::string& word, const std::vector<std::string>& words) {
  if (std::ranges::find(words, word) == words.end()) {
    const std::vector<std::string> first(words.begin(), words.end() - 1);
    throw Error(where, in_quotes(word) + " is not known",
                "use " + joined_words(first, ", ") + (first.empty() ? "" : " or ") + words.back());
  }
}

Choices<Precision> precisions(Precision usual) {
  Choices<Precision> all{{"float", Precision::single_precision}, {"double", Precision::double_precision}};
  if (usual == Precision::double_precision) {
    std::ranges::reverse(all);
  }
  return all;
}

CLI::Option* add_precision(CLI::App& app, Precision usual) {
  const auto all = precisions(usual);
  return add_choice(app, "--precision", all, "precision of the solver [" + all.front().first + "]");
}

Choices<RelaxationScheme> schemes(bool sweeps_only) {
  Choices<RelaxationScheme> all;
  for (const RelaxationSchemeInfo& one : relaxation_schemes) {
    if (one.sweeps || !sweeps_only) {
      all.emplace_back(one.name, one.scheme);
    }
  }
  return all;
}

CLI::Option* add_relaxation(CLI::App& app, bool sweeps_only, RelaxationScheme usual) {
  const auto all = schemes(sweeps_only);
  std::string help = "relaxation scheme";
  for (const auto& [name, scheme] : all) {
    help += "; " + name + ": " + std::string(info(scheme).summary);
  }
  return add_choice(app, "--relaxation", all, help + " [" + std::string(info(usual).name) + "]");
}

CLI::Option* add_space(CLI::App& app) {
  return add_choice(app, "--space", spaces,
                    "number of coordinates [from the file, otherwise the number of axes along which the mesh extends]");
}

std::vector<std::string> names_of(std::span<const AlgorithmInfo> offered) {
  std::vector<std::string> names;
  for (const AlgorithmInfo& one : offered) {
    names.emplace_back(one.offered_name());
  }
  return names;
}

std::string algorithms_help(std::span<const AlgorithmInfo> offered) {
  constexpr std::size_t column = 15;
  std::string text;
  for (const AlgorithmInfo& one : offered) {
    const std::string name(one.offered_name());
    text += "  " + name + std::string(column - std::min(column - 1, name.size()), ' ') + std::string(one.label) + ": " +
            std::string(one.summary) + "\n";
  }
  return text;
}

Algorithm algorithm_of(const std::string& where, const std::string& name, std::span<const AlgorithmInfo> offered) {
  const auto algorithm = find_algorithm(name);
  if (!algorithm || std::ranges::find(offered, *algorithm, &AlgorithmInfo::algorithm) == offered.end()) {
    check_word(where, name, names_of(offered));
  }
  return *algorithm;
}

std::vector<Algorithm> algorithms_of(const CLI::Option* option, std::span<const AlgorithmInfo> offered) {
  std::vector<Algorithm> chosen;
  if (const auto list = value_of(option)) {
    for (const std::string& word : words_of(option->get_name(), *list)) {
      chosen.push_back(algorithm_of(option->get_name(), word, offered));
      if (std::ranges::count(chosen, chosen.back()) > 1) {
        throw Error(option->get_name(), in_quotes(word) + " is given twice", "write each algorithm once");
      }
    }
  }
  return chosen;
}

MeshOptions add_mesh_options(CLI::App& app, Welding welding) {
  MeshOptions options;
  options.path = add_value(app, "MESH", "", "mesh file: " + mesh_endings(FormatUse::read))->required();
  options.size = add_value(app, "--size", "WxH[xD]", "number of elements of a .dat file along each axis");
  options.spacing =
      add_value(app, "--spacing", "NUMBER", "distance between the elements of a .dat file; overrides the file");
  options.threshold = add_value(app, "--threshold", "D",
                                "lowest density that counts as material, for volumes of voxels [Otsu's method]");
  options.voxels =
      add_value(app, "--voxels", "N", "voxels per element along each axis [chosen to limit the number of elements]");
  options.by_density = add_choice(app, "--density-softness", on_or_off, "make denser voxels stiffer [on]");
  options.data_outside =
      add_value(app, "--data-outside", "allow|refuse", "data files outside the folder of a volume's header [refuse]");
  if (welding == Welding::by_reader) {
    options.weld = add_value(app, "--weld", "TOLERANCE",
                             "join points this close, in mesh units [STL: 1e-7 of the extent; others: not]");
  }
  return options;
}

double tolerance_of(const std::string& text) {
  const double tolerance = parse_number_of("--weld", text);
  if (tolerance < 0 || tolerance > coordinate_limit) {
    throw Error("--weld", in_quotes(text) + " is not a distance", "write a number from 0, in mesh units");
  }
  return tolerance;
}

OpenedMesh open_mesh(const MeshOptions& options) { return open_mesh(options, open_file(*value_of(options.path))); }

OpenedMesh open_mesh(const MeshOptions& options, InputFile input) {
  const ReadOptions how = read_options_of(options);
  Watch watch("reading " + shown(input.file.path()));
  return in_options({{"space dimension", "--space"},
                     {"size", "--size"},
                     {"spacing", "--spacing"},
                     {"threshold", "--threshold"},
                     {"every", "--voxels"}},
                    [&] { return chainmail::open_mesh(std::move(input), how, watch.progress()); });
}

CLI::Option* add_mesh_target(CLI::App& app, const std::string& name) {
  return add_value(app, name, "FILE", "output file: " + mesh_endings(FormatUse::write))->required();
}

void say_note(const std::string& words) {
  if (!words.empty()) {
    std::cerr << "chainmail: note: " << words << '\n';
  }
}

void say_flaws(const OpenedMesh& opened) { say_note(in_words(opened.flaws)); }

void add_mesh_file(Outputs& outputs, const MeshOptions& read, const std::string& target, const MeshPointer& mesh,
                   const OwnSoftness& softness) {
  const MeshFormat& format = mesh_format(target, FormatUse::write);
  check_holds(format, *mesh, target);
  say_note(lost_in(format, *mesh));
  outputs.keep(*value_of(read.path));
  outputs.add(target, [&format, mesh, softness](std::ostream& out) { write_mesh(out, format, *mesh, softness); });
}

void write_mesh_file(const MeshOptions& read, const std::string& target, const MeshPointer& mesh,
                     const OwnSoftness& softness) {
  Outputs outputs;
  add_mesh_file(outputs, read, target, mesh, softness);
  outputs.commit();
}

Error at_option(const Error& error, const std::map<std::string, std::string>& options) {
  // An error of core begins with the name of a value, like `size` or `space dimension 2`. The table has the name
  // without the number.
  const std::string what = error.where().substr(0, error.where().find_last_not_of(" 0123456789") + 1);
  const auto option = options.find(what);
  return option == options.end() ? error : error.at(option->second + error.where().substr(what.size()));
}

}  // namespace chainmail::command_line
