#include "command_line/common.h"

namespace chainmail::command_line {
namespace {

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

using Names = std::vector<std::string>;

std::string spaced(const Names& words) { return CLI::detail::join(words, " "); }

std::string help_of(const CLI::Option& option) { return first_sentence(option.get_description()); }

/// Returns the value as in the help; empty if there is none.
std::string value_name(const CLI::Option& option) {
  return option.get_items_expected_max() > 0 ? option.get_type_name() : "";
}

/// Returns the names with dashes; none for a positional argument.
Names names_of(const CLI::Option& option) {
  Names names;
  std::ranges::transform(option.get_snames(), std::back_inserter(names), [](const auto& name) { return "-" + name; });
  std::ranges::transform(option.get_lnames(), std::back_inserter(names), [](const auto& name) { return "--" + name; });
  return names;
}

/// Returns the words that the value may be, separated by blanks.
std::string choices_of(const CLI::Option& option) {
  const Names choices = choices_in(value_name(option));
  return spaced(choices.empty() ? choices_in(help_of(option)) : choices);
}

bool is_file(const CLI::Option& option) {
  const std::string value = value_name(option);
  return option.get_name() == "MESH" || value.find("FILE") != std::string::npos || value == "FOLDER";
}

using Apps = std::vector<const CLI::App*>;

std::vector<const CLI::Option*> options_of(const CLI::App& app) {
  return app.get_options([](const CLI::Option* option) { return option->nonpositional(); });
}

std::vector<const CLI::Option*> positionals_of(const CLI::App& app) {
  return app.get_options([](const CLI::Option* option) { return !option->nonpositional(); });
}

std::string option_names(const CLI::App& app) {
  Names all;
  for (const CLI::Option* option : options_of(app)) {
    std::ranges::copy(names_of(*option), std::back_inserter(all));
  }
  return spaced(all);
}

/// Returns a text in single quotes. A quote inside becomes a typographic one, which means nothing to a shell.
std::string quoted(std::string text) {
  for (std::size_t at = 0; (at = text.find('\'', at)) != std::string::npos;) {
    text.replace(at, 1, "\u2019");
  }
  return '\'' + text + '\'';
}

// bash

/// Writes the values of an option, or of a positional argument, after this word. After an option with other values, and
/// for other positional arguments, bash completes files.
void write_bash_values(std::ostream& out, const std::string& before, const CLI::Option& option) {
  if (const std::string choices = choices_of(option); !choices.empty()) {
    out << "    '" << before << "') words='" << choices << "' ;;\n";
  }
}

void write_bash(std::ostream& out, const CLI::App& root, const Apps& commands) {
  out << "# bash completion for chainmail, made by: chainmail completion bash\n"
         "_chainmail() {\n"
         "  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} words=''\n"
         "  COMPREPLY=()\n"
         "  case \"${COMP_WORDS[1]} $before\" in\n";
  for (const CLI::App* command : commands) {
    for (const CLI::Option* option : options_of(*command)) {
      for (const std::string& name : names_of(*option)) {
        write_bash_values(out, command->get_name() + ' ' + name, *option);
      }
    }
    if (const auto positionals = positionals_of(*command); !positionals.empty()) {
      write_bash_values(out, command->get_name() + ' ' + command->get_name(), *positionals.front());
    }
  }
  out << "  esac\n"
         "  if [[ $COMP_CWORD -eq 1 ]]; then\n    words='";
  for (const CLI::App* command : commands) {
    out << command->get_name() << ' ';
  }
  out << option_names(root) << "'\n  elif [[ -z $words && $word == -* ]]; then\n    case ${COMP_WORDS[1]} in\n";
  for (const CLI::App* command : commands) {
    out << "      " << command->get_name() << ") words='" << option_names(*command) << "' ;;\n";
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

std::string zsh_action(const CLI::Option& option) {
  const std::string choices = choices_of(option);
  return is_file(option) ? "_files" : choices.empty() ? " " : "(" + choices + ")";
}

void write_zsh_option(std::ostream& out, const CLI::Option& option) {
  const std::string type = value_name(option), help = for_zsh(help_of(option));
  for (const std::string& name : names_of(option)) {
    out << " \\\n        "
        << quoted("*" + name + "[" + help + "]" + (type.empty() ? "" : ":" + for_zsh(type) + ":" + zsh_action(option)));
  }
  if (!option.nonpositional()) {
    out << " \\\n        " << quoted((option.get_allow_extra_args() ? "*:" : ":") + help + ":" + zsh_action(option));
  }
}

void write_zsh(std::ostream& out, const CLI::App& root, const Apps& commands) {
  out << "#compdef chainmail\n# zsh completion for chainmail, made by: chainmail completion zsh\n"
         "_chainmail() {\n"
         "  if (( CURRENT == 2 )); then\n"
         "    local -a commands=(";
  for (const CLI::App* command : commands) {
    out << "\n      " << quoted(command->get_name() + ":" + first_sentence(command->get_description()));
  }
  out << ")\n    _describe command commands\n    compadd -- " << option_names(root)
      << "\n    return\n  fi\n"
         "  local command=$words[2]\n"
         "  shift words\n"
         "  (( CURRENT-- ))\n"
         "  case $command in\n";
  for (const CLI::App* command : commands) {
    out << "    " << command->get_name() << ")\n      _arguments";
    for (const auto& options : {options_of(*command), positionals_of(*command)}) {
      std::ranges::for_each(options, [&](const CLI::Option* option) { write_zsh_option(out, *option); });
    }
    out << " ;;\n";
  }
  out << "  esac\n"
         "}\n"
         "[[ $funcstack[1] == _chainmail ]] && _chainmail \"$@\" || compdef _chainmail chainmail\n";
}

// fish

/// Writes the names, the values and the help of an option.
void write_fish_option(std::ostream& out, const CLI::Option& option, bool with_value) {
  for (const std::string& name : names_of(option)) {
    out << (name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1));
  }
  if (const std::string choices = choices_of(option); with_value && !value_name(option).empty()) {
    out << (is_file(option) ? " -r -F" : choices.empty() ? " -x" : " -x -a " + quoted(choices));
  }
  out << " -d " << quoted(help_of(option)) << '\n';
}

void write_fish(std::ostream& out, const CLI::App& root, const Apps& commands) {
  const std::string first = "complete -c chainmail -n __fish_use_subcommand";
  out << "# fish completion for chainmail, made by: chainmail completion fish\n";
  for (const CLI::App* command : commands) {
    out << first << " -f -a " << command->get_name() << " -d " << quoted(first_sentence(command->get_description()))
        << '\n';
  }
  for (const CLI::Option* option : options_of(root)) {
    write_fish_option(out << first, *option, false);
  }
  for (const CLI::App* command : commands) {
    const std::string when = "complete -c chainmail -n '__fish_seen_subcommand_from " + command->get_name() + "'";
    for (const CLI::Option* option : options_of(*command)) {
      write_fish_option(out << when, *option, true);
    }
    for (const CLI::Option* option : positionals_of(*command)) {
      if (const std::string choices = choices_of(*option); !choices.empty()) {
        out << when << " -f -a " << quoted(choices) << '\n';
      }
    }
  }
}

const std::map<std::string, void (*)(std::ostream&, const CLI::App&, const Apps&)> shells{
    {"bash", write_bash}, {"zsh", write_zsh}, {"fish", write_fish}};

void write_completion(const CLI::App& root, const std::string& shell) {
  const auto found = shells.find(shell);
  require(found != shells.end(), "SHELL", "there is no completion for '" + shell + "'", "use bash, zsh or fish");
  const Apps commands = root.get_subcommands([](const CLI::App*) { return true; });
  write_file("-", [&](std::ostream& out) { found->second(out, root, commands); });
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
