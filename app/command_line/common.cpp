#include "command_line/common.h"

#include <cctype>
#include <iostream>

#include "version/version.h"

namespace chainmail::command_line {

void require(bool holds, const std::string& where, const std::string& problem, const std::string& remedy) {
  if (!holds) {
    throw Error(where, problem, remedy);
  }
}

// Values

void check_word(const std::string& where, const std::string& word, const std::vector<std::string>& words) {
  const std::vector<std::string> first(words.begin(), words.end() - 1);
  require(std::ranges::find(words, word) != words.end(), where, in_quotes(word) + " is not known",
          "use " + joined_words(first, ", ") + (first.empty() ? "" : " or ") + words.back());
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
    require(std::ranges::find(words, word) == words.end(), where, in_quotes(word) + " is given twice",
            "write each one once");
    words.emplace_back(word);
  }
  return words;
}

double parse_number_of(const std::string& where, std::string_view text) {
  const auto number = parse_number(text);
  require(number.has_value(), where, in_quotes(text) + " is not a finite number",
          "write a decimal number like 0.5 or -2e3");
  return *number;
}

std::function<std::uint32_t(const std::string& where, const std::string& text)> count_from(std::uint32_t lowest,
                                                                                           std::uint32_t highest) {
  return [=](const std::string& where, const std::string& text) {
    const auto number = parse_count(text);
    require(number && *number >= lowest && *number <= highest, where,
            in_quotes(text) + " is not a whole number in range",
            "use " + std::to_string(lowest) + " to " + std::to_string(highest));
    return *number;
  };
}

std::function<double(const std::string& where, const std::string& text)> number_in(const Parameter& parameter) {
  return [&parameter](const std::string& where, const std::string& text) {
    const double number = parse_number_of(where, text);
    check_option(parameter, number);
    return number;
  };
}

std::vector<double> numbers_of(const MemberInfo& member, const std::string& where, const std::string& text) {
  const bool is_list = member.count > 1;
  std::string name(member.label);
  name.front() = char(std::tolower(static_cast<unsigned char>(name.front())));
  std::vector<double> numbers;
  for (const std::string_view word : is_list ? split(text, 'x') : std::vector<std::string_view>{text}) {
    const auto count = member.is_whole ? parse_count(word) : std::nullopt;
    require((count || !member.is_whole) && numbers.size() < member.count, where,
            in_quotes(text) + " is not a number of " + name,
            is_list ? "write one number for all axes, or one for each, as 4x4x4" : "use " + range_of(*member.number));
    numbers.push_back(count ? *count : parse_number_of(where, word));
  }
  numbers.resize(member.count, numbers.back());  // a plane has no third axis
  for (const double number : numbers) {
    check_option(*member.number, number);
  }
  return numbers;
}

std::string option_of(const Parameter& parameter) { return "--" + std::string(parameter.name); }

void check_option(const Parameter& parameter, double value) {
  error_at(option_of(parameter), [&] { check(parameter, value); });
}

std::string help_of(std::string_view help, double default_value) {
  std::string text = std::string(help) + " [";
  append_number(text, default_value);
  return text + "]";
}

// Options

CLI::Option* add_value(CLI::App& app, const std::string& name, const std::string& type, const std::string& help) {
  return app.add_option(name, help)
      ->type_name(type)
      ->expected(1)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

std::optional<std::string> value_of(const CLI::Option* option) {
  const auto& values = option->results();
  require(values.size() < 2, option->get_name(), "it was given " + std::to_string(values.size()) + " times",
          "use it once");
  return values.empty() ? std::nullopt : std::optional(values.front());
}

void add_precision(Options& options, Precision& precision) {
  Choices<Precision> all{{std::string(name(Precision::single_precision)), Precision::single_precision},
                         {std::string(name(Precision::double_precision)), Precision::double_precision}};
  if (precision == Precision::double_precision) {
    std::ranges::reverse(all);
  }
  options.add("--precision", all, "precision of the solver [" + all.front().first + "]", precision);
}

void add_relaxation(Options& options, bool sweeps_only, RelaxationScheme& scheme) {
  Choices<RelaxationScheme> all;
  std::string help = "relaxation scheme";
  for (const RelaxationSchemeInfo& one : relaxation_schemes) {
    if (one.sweeps || !sweeps_only) {
      all.emplace_back(one.name, one.scheme);
      help += "; " + all.back().first + ": " + std::string(one.summary);
    }
  }
  options.add("--relaxation", all, help + " [" + std::string(info(scheme).name) + "]", scheme);
}

void add_algorithms(Options& options, const std::string& help, std::span<const AlgorithmInfo> (*offered)(),
                    std::vector<Algorithm>& algorithms) {
  options.add("--algorithms", "A,B,…", help, algorithms, [offered](const std::string& where, const std::string& list) {
    return algorithms_of(where, list, offered());
  });
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

std::vector<Algorithm> algorithms_of(const std::string& where, const std::string& list,
                                     std::span<const AlgorithmInfo> offered) {
  std::vector<Algorithm> chosen;
  for (const std::string& word : words_of(where, list)) {
    chosen.push_back(algorithm_of(where, word, offered));
    require(std::ranges::count(chosen, chosen.back()) == 1, where, in_quotes(word) + " is given twice",
            "write each algorithm once");
  }
  return chosen;
}

// Meshes

std::shared_ptr<MeshArguments> add_mesh(CLI::App& app) {
  auto mesh = add_mesh_path(app);
  add_layout(*mesh);
  add_weld(*mesh);
  return mesh;
}

std::shared_ptr<MeshArguments> add_mesh_path(CLI::App& app) {
  auto mesh = std::make_shared<MeshArguments>(MeshArguments{Options(app)});
  add_value(app, "MESH", "", "mesh file: " + mesh_endings(FormatUse::read))->required();
  return mesh;
}

void add_layout(MeshArguments& mesh) {
  Options& options = mesh.options;
  ReadOptions& how = mesh.how;
  options.add("--size", "WxH[xD]", "number of elements of a .dat file along each axis", how.size,
              [](const std::string& where, const std::string& text) {
                const auto size = parse_size(text);
                require(size.has_value(), where, in_quotes(text) + " is not a size",
                        "write WxH or WxHxD with whole numbers from 1");
                return *size;
              });
  options.add("--spacing", "NUMBER", "distance between the elements of a .dat file; overrides the file", how.spacing,
              number_in(parameters::spacing));
  options.add("--threshold", "D", "lowest density that counts as material, for volumes of voxels [Otsu's method]",
              how.voxels.threshold, parse_number_of);
  options.add("--voxels", "N", "voxels per element along each axis [chosen to limit the number of elements]",
              how.voxels.every, count_from(1));
  options.add("--density-softness", on_or_off, "make denser voxels stiffer [on]", how.voxels.stiff_where_dense);
  options.add("--data-outside", Choices<bool>{{"allow", true}, {"refuse", false}},
              "data files outside the folder of a volume's header [refuse]", how.data_outside);
}

void add_weld(MeshArguments& mesh) {
  mesh.options.add("--weld", "TOLERANCE",
                   "join points this close, in mesh units [STL: 1e-7 of the extent; others: not]", mesh.how.weld,
                   tolerance_of);
}

void add_space(MeshArguments& mesh) {
  mesh.options.add("--space", spaces,
                   "number of coordinates [from the file, otherwise the number of axes along which the mesh extends]",
                   mesh.how.space_dimension);
}

double tolerance_of(const std::string& where, const std::string& text) {
  const double tolerance = parse_number_of(where, text);
  require(tolerance >= 0 && tolerance <= coordinate_limit, where, in_quotes(text) + " is not a distance",
          "write a number from 0, in mesh units");
  return tolerance;
}

OpenedMesh open_mesh(const MeshArguments& mesh) { return open_mesh(mesh, open_file(mesh.path())); }

OpenedMesh open_mesh(const MeshArguments& mesh, InputFile input) {
  return watched("reading " + shown(input.file.path()),
                 {{"space dimension", "--space"},
                  {"size", "--size"},
                  {"spacing", "--spacing"},
                  {"threshold", "--threshold"},
                  {"every", "--voxels"}},
                 [&](const Progress& progress) { return chainmail::open_mesh(std::move(input), mesh.how, progress); });
}

OpenedMesh open_mesh(const std::string& path) {
  return watched("reading " + shown(path), {},
                 [&](const Progress& progress) { return chainmail::open_mesh(path, {}, progress); });
}

// Outputs

report::Origin origin_of(const std::string& command_line) {
  return {report::this_machine(), command_line, report::now_in_words(), version_in_words("chainmail")};
}

void say_note(const std::string& words) {
  if (!words.empty()) {
    std::cerr << "chainmail: note: " << words << '\n';
  }
}

void say_flaws(const OpenedMesh& opened) { say_note(in_words(opened.flaws)); }

CLI::Option* add_mesh_target(CLI::App& app, const std::string& name) {
  return add_value(app, name, "FILE", "output file: " + mesh_endings(FormatUse::write))->required();
}

void check_outputs(const std::vector<std::string>& read, const std::vector<std::optional<std::string>>& paths) {
  Outputs outputs;
  std::ranges::for_each(read, [&](const std::string& input) { outputs.keep(input); });
  for (const auto& path : paths) {
    if (path) {
      outputs.add(*path, [](std::ostream&) {});  // is never put in place
    }
  }
}

void check_mesh_output(const std::string& read, const std::string& target, const std::optional<std::string>& other) {
  mesh_format(target, FormatUse::write);
  check_outputs({read}, {target, other});
}

void add_mesh_file(Outputs& outputs, const std::string& read, const std::string& target, const MeshPointer& mesh,
                   const OwnSoftness& softness) {
  const MeshFormat& format = mesh_format(target, FormatUse::write);
  check_holds(format, *mesh, target);
  say_note(lost_in(format, *mesh));
  outputs.keep(read);
  outputs.add(target, [&format, mesh, softness, name = shown(target)](std::ostream& out) {
    const Watch watch("writing " + name);
    write_mesh(out, format, *mesh, softness, watch.progress());
  });
}

void write_mesh_file(const std::string& read, const std::string& target, const MeshPointer& mesh,
                     const OwnSoftness& softness) {
  Outputs outputs;
  add_mesh_file(outputs, read, target, mesh, softness);
  outputs.commit();
}

void add_files(Outputs& outputs, const std::vector<OutputFile>& files) {
  for (const OutputFile& file : files) {
    if (file.path) {
      outputs.add(*file.path, file.writer);
    }
  }
}

void write_outputs(const std::vector<std::string>& read, const std::vector<OutputFile>& files) {
  Outputs outputs;
  for (const std::string& input : read) {
    outputs.keep(input);
  }
  add_files(outputs, files);
  outputs.commit();
}

std::optional<std::string> free_output(const std::vector<std::optional<std::string>>& paths) {
  return std::ranges::find(paths, standard_output) == paths.end() ? standard_output : std::nullopt;
}

Error at_option(const Error& error, const std::map<std::string, std::string>& options) {
  // An error of core begins with the name of a value, like `size` or `space dimension 2`. The table has the name
  // without the number.
  const std::string what = error.where().substr(0, error.where().find_last_not_of(" 0123456789") + 1);
  const auto option = options.find(what);
  return option == options.end() ? error : error.at(option->second + error.where().substr(what.size()));
}

}  // namespace chainmail::command_line
