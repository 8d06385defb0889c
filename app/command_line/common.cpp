#include "command_line/common.h"

#include <algorithm>
#include <array>

#include "command_line/watched.h"
#include "files/text/text.h"
#include "mesh/error.h"

namespace chainmail::command_line {
namespace {

constexpr std::uint32_t highest_whole_number = 1'000'000'000;

std::string digits(double number) {
  std::string text;
  append_number(text, number);
  return text;
}

std::string name_of(const Parameter& parameter) { return "--" + std::string(parameter.name); }

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    text += i == 0 ? "" : i + 1 == words.size() ? " or " : ", ";
    text += words[i];
  }
  return text;
}

std::string range_of(const Parameter& parameter) {
  if (parameter.lowest == parameters::above_zero) {
    return "a number above 0";
  }
  return digits(parameter.lowest) +
         (parameter.highest == parameters::no_highest ? " or more" : " to " + digits(parameter.highest));
}

}  // namespace

CLI::Option* add_value(CLI::App& app, const std::string& name, const std::string& type, const std::string& help) {
  return app.add_option(name, help)
      ->type_name(type)
      ->expected(1)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

CLI::Option* add_parameter(CLI::App& app, const Parameter& parameter) {
  return add_value(app, name_of(parameter), "NUMBER",
                   std::string(parameter.help) + " [" + digits(parameter.standard) + "]");
}

std::optional<std::string> value_of(const CLI::Option* option) {
  const auto& values = option->results();
  if (values.empty()) {
    return std::nullopt;
  }
  if (values.size() > 1) {
    throw Error(option->get_name(), "it is given " + std::to_string(values.size()) + " times", "give it once");
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

double value_of(const CLI::Option* option, const Parameter& parameter) {
  const auto text = value_of(option);
  if (!text) {
    return parameter.standard;
  }
  const double number = parse_number_of(name_of(parameter), *text);
  if (!(number >= parameter.lowest && number <= parameter.highest)) {
    throw Error(name_of(parameter), *text + " lies out of its range", "use " + range_of(parameter));
  }
  return number;
}

std::uint32_t whole_number_of(const CLI::Option* option, std::uint32_t lowest, std::uint32_t standard) {
  const auto text = value_of(option);
  if (!text) {
    return standard;
  }
  const auto number = parse_count(*text);
  if (!number || *number < lowest || *number > highest_whole_number) {
    throw Error(option->get_name(), in_quotes(*text) + " is not a whole number that it can be",
                "use " + std::to_string(lowest) + " to " + std::to_string(highest_whole_number));
  }
  return *number;
}

void check_word(const std::string& where, const std::string& word, const std::vector<std::string>& words) {
  if (std::find(words.begin(), words.end(), word) == words.end()) {
    throw Error(where, in_quotes(word) + " is not known", "use " + joined(words));
  }
}

std::vector<std::string> words_of(const std::string& where, const std::string& list) {
  std::vector<std::string> words;
  for (std::size_t begin = 0; begin <= list.size();) {
    const std::size_t end = std::min(list.find(',', begin), list.size());
    const std::string word = list.substr(begin, end - begin);
    if (std::find(words.begin(), words.end(), word) != words.end()) {
      throw Error(where, in_quotes(word) + " stands there twice", "name each once");
    }
    words.push_back(word);
    begin = end + 1;
  }
  return words;
}

std::optional<int> space_of(const CLI::Option* option) {
  const auto text = value_of(option);
  if (!text) {
    return std::nullopt;
  }
  check_word("--space", *text, {"1", "2", "3"});
  return text->front() - '0';
}

MeshOptions add_mesh_options(CLI::App& app) {
  MeshOptions options;
  options.path = add_value(app, "MESH", "", "the mesh, a file " + mesh_endings(FormatUse::read))->required();
  options.size = add_value(app, "--size", "WxH[xD]", "how many elements a .dat file has along each axis");
  options.spacing = add_value(app, "--spacing", "NUMBER", "their distance, before what the file states");
  options.threshold = add_value(app, "--threshold", "D", "the lowest density of a volume that is there [Otsu's]");
  options.voxels = add_value(app, "--voxels", "N", "how many voxels along each axis make an element [few enough]");
  options.by_density =
      add_value(app, "--density-softness", "on|off", "whether a volume is the stiffer where it is denser [on]");
  options.data_outside = add_value(app, "--data-outside", "allow|refuse",
                                   "whether the header of a volume may name data outside its own folder [refuse]");
  return options;
}

VoxelOptions voxels_of(const MeshOptions& options) {
  VoxelOptions voxels;
  if (const auto threshold = value_of(options.threshold)) {
    voxels.threshold = parse_number_of("--threshold", *threshold);
  }
  if (options.voxels->count() > 0) {
    voxels.every = whole_number_of(options.voxels, 1, 1);
  }
  if (const auto word = value_of(options.by_density)) {
    check_word("--density-softness", *word, {"on", "off"});
    voxels.stiff_where_dense = *word == "on";
  }
  return voxels;
}

bool data_outside_of(const MeshOptions& options) {
  const auto word = value_of(options.data_outside);
  if (word) {
    check_word("--data-outside", *word, {"allow", "refuse"});
  }
  return word == "allow";
}

OpenedMesh open_mesh(const MeshOptions& options) {
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
  how.space_dimension = options.space == nullptr ? std::nullopt : space_of(options.space);
  how.voxels = voxels_of(options);
  how.data_outside = data_outside_of(options);
  const std::filesystem::path path = *value_of(options.path);
  Watch watch("reading " + shown(path));
  return in_options({{"space dimension", "--space"}},
                    [&] { return chainmail::open_mesh(path, how, watch.progress()); });
}

Error at_option(const Error& error, const std::map<std::string, std::string>& options) {
  // What the core says of a value, `size` or `space dimension 2`, stands without the number in the table.
  const std::string what = error.where().substr(0, error.where().find_last_not_of(" 0123456789") + 1);
  const auto option = options.find(what);
  return option == options.end() ? error : error.at(option->second + error.where().substr(what.size()));
}

}  // namespace chainmail::command_line
