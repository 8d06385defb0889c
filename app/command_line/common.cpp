#include "command_line/common.h"

#include <algorithm>
#include <array>
#include <iostream>
#include <iterator>

#include "command_line/progress_line.h"

namespace chainmail::command_line {
namespace {

std::string name_of(const api::Parameter& parameter) { return "--" + std::string(parameter.name); }

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    text += i == 0 ? "" : i + 1 == words.size() ? " or " : ", ";
    text += words[i];
  }
  return text;
}

}  // namespace

CLI::Option* add_value(CLI::App& app, const std::string& name, const std::string& type, const std::string& help) {
  return app.add_option(name, help)
      ->type_name(type)
      ->expected(1)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

std::string help_of(const api::Parameter& parameter) {
  return std::string(parameter.help) + " [" + api::digits_of(parameter.default_value) + "]";
}

CLI::Option* add_parameter(CLI::App& app, const api::Parameter& parameter) {
  return add_value(app, name_of(parameter), "NUMBER", help_of(parameter));
}

std::optional<std::string> value_of(const CLI::Option* option) {
  const auto& values = option->results();
  if (values.empty()) {
    return std::nullopt;
  }
  if (values.size() > 1) {
    throw api::Error(option->get_name(), "it was given " + std::to_string(values.size()) + " times", "use it once");
  }
  return values.front();
}

double parse_number_of(const std::string& where, std::string_view text) {
  const auto number = api::parse_number(text);
  if (!number) {
    throw api::Error(where, api::in_quotes(text) + " is not a finite number",
                     "write a decimal number like 0.5 or -2e3");
  }
  return *number;
}

double value_of(const CLI::Option* option, const api::Parameter& parameter) {
  const auto text = value_of(option);
  if (!text) {
    return parameter.default_value;
  }
  const double number = parse_number_of(name_of(parameter), *text);
  in_options({{std::string(parameter.name), name_of(parameter)}}, [&] { api::check(parameter, number); });
  return number;
}

std::uint32_t whole_number_of(const CLI::Option* option, std::uint32_t lowest, std::uint32_t default_value,
                              std::uint32_t highest) {
  const auto text = value_of(option);
  if (!text) {
    return default_value;
  }
  const auto number = api::parse_count(*text);
  if (!number || *number < lowest || *number > highest) {
    throw api::Error(option->get_name(), api::in_quotes(*text) + " is not a whole number in range",
                     "use " + std::to_string(lowest) + " to " + std::to_string(highest));
  }
  return *number;
}

void check_word(const std::string& where, const std::string& word, const std::vector<std::string>& words) {
  if (std::find(words.begin(), words.end(), word) == words.end()) {
    throw api::Error(where, api::in_quotes(word) + " is not known", "use " + joined(words));
  }
}

const api::RelaxationSchemeInfo& info(api::RelaxationScheme scheme) {
  return api::relaxation_schemes()[std::size_t(scheme)];
}

CLI::Option* add_relaxation(CLI::App& app, bool sweeps_only, api::RelaxationScheme usual) {
  std::string names, help = "relaxation scheme";
  for (const api::RelaxationSchemeInfo& one : api::relaxation_schemes()) {
    if (one.sweeps || !sweeps_only) {
      names += (names.empty() ? "" : "|") + std::string(one.name);
      help += "; " + std::string(one.name) + ": " + std::string(one.help);
    }
  }
  return add_value(app, "--relaxation", names, help + " [" + std::string(info(usual).name) + "]");
}

api::RelaxationScheme relaxation_of(const CLI::Option* option, bool sweeps_only, api::RelaxationScheme usual) {
  std::vector<std::string> names;
  for (const api::RelaxationSchemeInfo& one : api::relaxation_schemes()) {
    if (one.sweeps || !sweeps_only) {
      names.emplace_back(one.name);
    }
  }
  const std::string word = value_of(option).value_or(std::string(info(usual).name));
  check_word(option->get_name(), word, names);
  return std::ranges::find(api::relaxation_schemes(), word, &api::RelaxationSchemeInfo::name)->scheme;
}

std::vector<std::string> words_of(const std::string& where, const std::string& list) {
  std::vector<std::string> words;
  for (std::size_t begin = 0; begin <= list.size();) {
    const std::size_t end = std::min(list.find(',', begin), list.size());
    const std::string word = list.substr(begin, end - begin);
    if (std::find(words.begin(), words.end(), word) != words.end()) {
      throw api::Error(where, api::in_quotes(word) + " is given twice", "write each one once");
    }
    words.push_back(word);
    begin = end + 1;
  }
  return words;
}

std::vector<api::MethodInfo> chainmail_methods() {
  auto methods = api::methods();
  std::erase_if(methods, [](const api::MethodInfo& one) { return one.family != api::MethodFamily::chainmail; });
  return methods;
}

std::vector<std::string> names_of(const std::vector<api::MethodInfo>& offered) {
  std::vector<std::string> names;
  std::ranges::transform(offered, std::back_inserter(names), &api::MethodInfo::name);
  return names;
}

std::string methods_help(const std::vector<api::MethodInfo>& offered) {
  constexpr std::size_t column = 15;
  std::string text;
  for (const api::MethodInfo& one : offered) {
    text += "  " + one.name + std::string(column - std::min(column - 1, one.name.size()), ' ') + one.label + ": " +
            one.summary + "\n";
  }
  return text;
}

std::string method_of(const std::string& where, const std::string& name, const std::vector<api::MethodInfo>& offered) {
  const auto method = api::find_method(name);
  if (!method || std::ranges::find(offered, method->name, &api::MethodInfo::name) == offered.end()) {
    throw api::Error(where, api::in_quotes(name) + " is not known", "use " + joined(names_of(offered)));
  }
  return method->name;
}

std::vector<std::string> methods_of(const CLI::Option* option, const std::vector<api::MethodInfo>& offered) {
  std::vector<std::string> chosen;
  if (const auto list = value_of(option)) {
    for (const std::string& word : words_of(option->get_name(), *list)) {
      chosen.push_back(method_of(option->get_name(), word, offered));
      if (std::ranges::count(chosen, chosen.back()) > 1) {
        throw api::Error(option->get_name(), api::in_quotes(word) + " is given twice", "write each algorithm once");
      }
    }
  }
  return chosen;
}

CLI::Option* add_precision(CLI::App& app, api::Precision usual) {
  return usual == api::Precision::single_precision
             ? add_value(app, "--precision", "float|double", "precision of the solver [float]")
             : add_value(app, "--precision", "double|float", "precision of the solver [double]");
}

api::Precision precision_of(const CLI::Option* option, api::Precision usual) {
  const auto word = value_of(option);
  if (!word) {
    return usual;
  }
  check_word("--precision", *word,
             usual == api::Precision::single_precision ? std::vector<std::string>{"float", "double"}
                                                       : std::vector<std::string>{"double", "float"});
  return *word == "float" ? api::Precision::single_precision : api::Precision::double_precision;
}

CLI::Option* add_energy(CLI::App& app, api::EnergyKind usual) {
  std::string names, usual_name, ignored;
  for (const api::EnergyKindInfo& one : api::energy_kinds()) {
    names += (names.empty() ? "" : "|") + std::string(one.name);
    usual_name = one.kind == usual ? one.name : usual_name;
  }
  const auto numbers = api::softness_numbers();
  for (std::size_t i = region_numbers; i + 1 < numbers.size(); ++i) {
    ignored += (ignored.empty() ? "" : ", ") + std::string(numbers[i].name);
  }
  return add_value(app, "--energy", names,
                   "elastic energy that relaxation lowers, of links or of the material of cells; isotropic ignores " +
                       ignored + " and " + std::string(numbers.back().name) + ", material too, at equilibrium [" +
                       usual_name + "]");
}

api::EnergyKind energy_of(const CLI::Option* option, api::EnergyKind usual) {
  const auto name = value_of(option);
  if (!name) {
    return usual;
  }
  std::vector<std::string> names;
  for (const api::EnergyKindInfo& one : api::energy_kinds()) {
    names.emplace_back(one.name);
  }
  check_word("--energy", *name, names);
  return std::ranges::find(api::energy_kinds(), *name, &api::EnergyKindInfo::name)->kind;
}

std::optional<int> space_of(const CLI::Option* option) {
  const auto text = value_of(option);
  if (!text) {
    return std::nullopt;
  }
  check_word("--space", *text, {"1", "2", "3"});
  return text->front() - '0';
}

MeshOptions add_mesh_options(CLI::App& app, Welding welding) {
  MeshOptions options;
  options.path = add_value(app, "MESH", "", "mesh file: " + api::file_endings(api::FileUse::read))->required();
  options.size = add_value(app, "--size", "WxH[xD]", "number of elements of a .dat file along each axis");
  options.spacing =
      add_value(app, "--spacing", "NUMBER", "distance between the elements of a .dat file; overrides the file");
  options.threshold = add_value(app, "--threshold", "D",
                                "lowest density that counts as material, for volumes of voxels [Otsu's method]");
  options.voxels =
      add_value(app, "--voxels", "N", "voxels per element along each axis [chosen to limit the number of elements]");
  options.by_density = add_value(app, "--density-softness", "on|off", "make denser voxels stiffer [on]");
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
  if (tolerance < 0 || tolerance > api::coordinate_limit) {
    throw api::Error("--weld", api::in_quotes(text) + " is not a distance", "write a number from 0, in mesh units");
  }
  return tolerance;
}

void read_voxels(const MeshOptions& options, api::ReadOptions& how) {
  if (const auto threshold = value_of(options.threshold)) {
    how.threshold = parse_number_of("--threshold", *threshold);
  }
  if (options.voxels->count() > 0) {
    how.every = whole_number_of(options.voxels, 1, 1);
  }
  if (const auto word = value_of(options.by_density)) {
    check_word("--density-softness", *word, {"on", "off"});
    how.stiff_where_dense = *word == "on";
  }
}

bool data_outside_of(const MeshOptions& options) {
  const auto word = value_of(options.data_outside);
  if (word) {
    check_word("--data-outside", *word, {"allow", "refuse"});
  }
  return word == "allow";
}

api::Mesh open_mesh(const MeshOptions& options) {
  api::ReadOptions how;
  if (const auto size = value_of(options.size)) {
    how.lattice = api::parse_size(*size);
    if (!how.lattice) {
      throw api::Error("--size", api::in_quotes(*size) + " is not a size",
                       "write WxH or WxHxD with whole numbers from 1");
    }
  }
  if (const double spacing = value_of(options.spacing, api::parameter("spacing")); options.spacing->count() > 0) {
    how.spacing = spacing;
  }
  how.space_dimension = options.space == nullptr ? std::nullopt : space_of(options.space);
  read_voxels(options, how);
  how.data_outside = data_outside_of(options);
  if (const auto tolerance = options.weld == nullptr ? std::nullopt : value_of(options.weld)) {
    how.weld = tolerance_of(*tolerance);
  }
  const std::filesystem::path path = *value_of(options.path);
  const Watch watch("reading " + api::shown(path));
  return in_options({{"space dimension", "--space"},
                     {"size", "--size"},
                     {"spacing", "--spacing"},
                     {"threshold", "--threshold"},
                     {"every", "--voxels"}},
                    [&] { return api::read_mesh(path, how, watch.job()); });
}

CLI::Option* add_mesh_target(CLI::App& app) {
  return add_value(app, "-o", "FILE", "output file: " + api::file_endings(api::FileUse::write))->required();
}

void say_note(const std::string& words) {
  if (!words.empty()) {
    std::cerr << "chainmail: note: " << words << '\n';
  }
}

void say_flaws(const api::Mesh& mesh) { say_note(mesh.flaws()); }

void add_mesh_file(api::Outputs& outputs, const MeshOptions& read, const std::string& target, const api::Mesh& mesh) {
  api::check_format(target, mesh);
  say_note(api::lost_in_format(target, mesh));
  outputs.keep(*value_of(read.path));
  outputs.add(target, [target, mesh](std::ostream& out) { api::write_mesh(out, target, mesh); });
}

void write_mesh_file(const MeshOptions& read, const std::string& target, const api::Mesh& mesh) {
  api::Outputs outputs;
  add_mesh_file(outputs, read, target, mesh);
  outputs.commit();
}

api::Error at_option(const api::Error& error, const std::map<std::string, std::string>& options) {
  // An error of the library begins with the name of a value, like `size` or `space dimension 2`. The table has the name
  // without the number.
  const std::string what = error.where().substr(0, error.where().find_last_not_of(" 0123456789") + 1);
  const auto option = options.find(what);
  return option == options.end() ? error : error.at(option->second + error.where().substr(what.size()));
}

}  // namespace chainmail::command_line
