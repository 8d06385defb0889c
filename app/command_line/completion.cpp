#include <algorithm>
#include <array>
#include <ostream>
#include <ranges>
#include <string>
#include <vector>

#include "command_line/common.h"

namespace chainmail::command_line {
namespace {

/// An option, or a positional argument, as a shell sees it.
struct Word {
  std::vector<std::string> names;  // with dashes; empty for a positional argument
  std::string help;                // one sentence
  std::string value;               // as in the help; empty if it has none
  std::vector<std::string> choices;
  bool is_file = false;
  bool repeats = false;
};

/// Returns the words of "a|b|c"; none for other texts.
std::vector<std::string> choices_in(const std::string& type) {
  const auto is_plain = [](char c) {
    return std::islower(static_cast<unsigned char>(c)) != 0 || std::isdigit(static_cast<unsigned char>(c)) != 0 ||
           c == '-';
  };
  if (type.find('|') == std::string::npos ||
      !std::ranges::all_of(type, [&](char c) { return is_plain(c) || c == '|'; })) {
    return {};
  }
  return CLI::detail::split(type, '|');
}

/// Returns the first line of a help text, without a default and without what follows a semicolon.
std::string first_sentence(const std::string& help) {
  const std::string line = help.substr(0, std::min({help.find('\n'), help.find(" ["), help.find(';')}));
  return line.ends_with(':') ? line.substr(0, line.size() - 1) : line;
}

Word word_of(const CLI::Option& option) {
  Word word;
  for (const std::string& name : option.get_snames()) {
    word.names.push_back("-" + name);
  }
  for (const std::string& name : option.get_lnames()) {
    word.names.push_back("--" + name);
  }
  word.help = first_sentence(option.get_description());
  word.value = option.get_items_expected_max() > 0 ? option.get_type_name() : "";
  word.choices = choices_in(word.value);
  if (word.choices.empty()) {
    word.choices = choices_in(word.help);
  }
  const bool is_mesh = word.names.empty() && option.get_single_name() == "MESH";
  word.is_file = is_mesh || word.value.find("FILE") != std::string::npos || word.value == "FOLDER";
  word.repeats = option.get_allow_extra_args();
  return word;
}

struct CommandWords {
  std::string name, help;
  std::vector<Word> options, positionals;
};

CommandWords words_of(const CLI::App& app) {
  CommandWords words{app.get_name(), first_sentence(app.get_description()), {}, {}};
  for (const CLI::Option* option : app.get_options()) {
    Word word = word_of(*option);
    (word.names.empty() ? words.positionals : words.options).push_back(std::move(word));
  }
  return words;
}

std::vector<CommandWords> words_of_all(const CLI::App& root) {
  std::vector<CommandWords> all;
  for (const CLI::App* app : root.get_subcommands([](const CLI::App*) { return true; })) {
    all.push_back(words_of(*app));
  }
  return all;
}

std::string spaced(const std::vector<std::string>& words) { return CLI::detail::join(words, " "); }

std::string option_names(const std::vector<Word>& words) {
  std::vector<std::string> names;
  for (const Word& word : words) {
    names.insert(names.end(), word.names.begin(), word.names.end());
  }
  return spaced(names);
}

/// Returns a text in single quotes. A quote inside becomes a typographic one, which means nothing to a shell.
std::string quoted(std::string text) {
  for (std::size_t at = 0; (at = text.find('\'', at)) != std::string::npos;) {
    text.replace(at, 1, "\u2019");
  }
  return '\'' + text + '\'';
}

// bash

/// Writes the values of options. After an option with other values, and for positional arguments, bash completes files.
void write_bash_values(std::ostream& out, const CommandWords& command, const Word& word, bool first_positional) {
  if (word.choices.empty()) {
    return;
  }
  for (const std::string& name : word.names) {
    out << "    '" << command.name << ' ' << name << "') words='" << spaced(word.choices) << "' ;;\n";
  }
  if (word.names.empty() && first_positional) {
    out << "    '" << command.name << ' ' << command.name << "') words='" << spaced(word.choices) << "' ;;\n";
  }
}

void write_bash(std::ostream& out, const CLI::App& root, const std::vector<CommandWords>& commands) {
  out << "# bash completion for chainmail, made by: chainmail completion bash\n"
         "_chainmail() {\n"
         "  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} words=''\n"
         "  COMPREPLY=()\n"
         "  case \"${COMP_WORDS[1]} $before\" in\n";
  for (const CommandWords& command : commands) {
    for (const Word& word : command.options) {
      write_bash_values(out, command, word, false);
    }
    if (!command.positionals.empty()) {
      write_bash_values(out, command, command.positionals.front(), true);
    }
  }
  out << "  esac\n"
         "  if [[ $COMP_CWORD -eq 1 ]]; then\n    words='";
  for (const CommandWords& command : commands) {
    out << command.name << ' ';
  }
  out << option_names(words_of(root).options)
      << "'\n  elif [[ -z $words && $word == -* ]]; then\n    case ${COMP_WORDS[1]} in\n";
  for (const CommandWords& command : commands) {
    out << "      " << command.name << ") words='" << option_names(command.options) << "' ;;\n";
  }
  out << "    esac\n"
         "  fi\n"
         "  # Without words, bash completes file names.\n"
         "  [[ -z $words ]] || mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$word\")\n"
         "}\n"
         "complete -o default -F _chainmail chainmail\n";
}

// zsh

/// Returns a help text for a specification of _arguments, in which brackets and colons have a meaning.
std::string for_zsh(const std::string& help) {
  std::string text;
  for (const char c : help) {
    text += c == '[' || c == ']' || c == ':' ? std::string("\\") + c : std::string(1, c);
  }
  return text;
}

std::string zsh_action(const Word& word) {
  return word.is_file ? "_files" : word.choices.empty() ? " " : "(" + spaced(word.choices) + ")";
}

std::string zsh_option(const Word& word) {
  const std::string value = word.value.empty() ? "" : ":" + for_zsh(word.value) + ":" + zsh_action(word);
  std::string specifications;
  for (const std::string& name : word.names) {
    specifications += " \\\n        " + quoted("*" + name + "[" + for_zsh(word.help) + "]" + value);
  }
  return specifications;
}

void write_zsh(std::ostream& out, const CLI::App& root, const std::vector<CommandWords>& commands) {
  out << "#compdef chainmail\n# zsh completion for chainmail, made by: chainmail completion zsh\n"
         "_chainmail() {\n"
         "  if (( CURRENT == 2 )); then\n"
         "    local -a commands=(";
  for (const CommandWords& command : commands) {
    out << "\n      " << quoted(command.name + ":" + command.help);
  }
  out << ")\n    _describe command commands\n    compadd -- " << option_names(words_of(root).options)
      << "\n    return\n  fi\n"
         "  local command=$words[2]\n"
         "  shift words\n"
         "  (( CURRENT-- ))\n"
         "  case $command in\n";
  for (const CommandWords& command : commands) {
    out << "    " << command.name << ")\n      _arguments";
    for (const Word& word : command.options) {
      out << zsh_option(word);
    }
    for (const Word& word : command.positionals) {
      out << " \\\n        " << quoted((word.repeats ? "*:" : ":") + for_zsh(word.help) + ":" + zsh_action(word));
    }
    out << " ;;\n";
  }
  out << "  esac\n"
         "}\n"
         "[[ $funcstack[1] == _chainmail ]] && _chainmail \"$@\" || compdef _chainmail chainmail\n";
}

// fish

std::string fish_names(const Word& word) {
  std::string names;
  for (const std::string& name : word.names) {
    names += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  }
  return names;
}

std::string fish_value(const Word& word) {
  if (word.value.empty()) {
    return "";
  }
  return word.is_file ? " -r -F" : word.choices.empty() ? " -x" : " -x -a " + quoted(spaced(word.choices));
}

void write_fish(std::ostream& out, const CLI::App& root, const std::vector<CommandWords>& commands) {
  out << "# fish completion for chainmail, made by: chainmail completion fish\n";
  for (const CommandWords& command : commands) {
    out << "complete -c chainmail -n __fish_use_subcommand -f -a " << command.name << " -d " << quoted(command.help)
        << '\n';
  }
  for (const Word& word : words_of(root).options) {
    out << "complete -c chainmail -n __fish_use_subcommand" << fish_names(word) << " -d " << quoted(word.help) << '\n';
  }
  for (const CommandWords& command : commands) {
    const std::string when = "complete -c chainmail -n '__fish_seen_subcommand_from " + command.name + "'";
    for (const Word& word : command.options) {
      out << when << fish_names(word) << fish_value(word) << " -d " << quoted(word.help) << '\n';
    }
    for (const Word& word : command.positionals) {
      if (!word.choices.empty()) {
        out << when << " -f -a " << quoted(spaced(word.choices)) << '\n';
      }
    }
  }
}

struct Shell {
  const char* name;
  void (*write)(std::ostream& out, const CLI::App& root, const std::vector<CommandWords>& commands);
};
constexpr std::array shells{Shell{"bash", write_bash}, Shell{"zsh", write_zsh}, Shell{"fish", write_fish}};

void write_completion(const CLI::App& root, const std::string& shell) {
  const auto* const found = std::ranges::find(shells, shell, &Shell::name);
  if (found == shells.end()) {
    throw Error("SHELL", "there is no completion for '" + shell + "'", "use bash, zsh or fish");
  }
  write_file("-", [&](std::ostream& out) { found->write(out, root, words_of_all(root)); });
}

}  // namespace

Command add_completion(CLI::App& root) {
  CLI::App& app = *root.add_subcommand("completion", "Print a script that completes options in a shell");
  CLI::Option* shell = add_value(app, "SHELL", "bash|zsh|fish", "the shell")->required();
  app.footer(
      "A package installs these scripts. Without a package, for bash:\n"
      "  chainmail completion bash > ~/.local/share/bash-completion/completions/chainmail");
  return {&app, [&root, shell] { write_completion(root, *value_of(shell)); }};
}

}  // namespace chainmail::command_line
