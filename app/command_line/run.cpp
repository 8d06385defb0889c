#include <algorithm>
#include <sstream>
#include <vector>

#include "command_line/common.h"
#include "files/text/program_folder.h"
#include "version/version.h"

namespace chainmail::command_line {
namespace {

constexpr const char* run_footer =
    "Exit status: 0 done; 2 bad usage or bad input, with one line on standard error and no output\n"
    "file changed; 1 any other error. The file name - is standard output.\n\n"
    "Example:\n"
    "  chainmail generate grid 9x7 -o grid.dat\n"
    "  chainmail deform grid.dat --algorithm natural-queue --by 31:3,2 --positions moved.csv";

constexpr const char* licence =
    "\nMIT licence. Linked libraries: Bullet (zlib), Eigen (MPL-2.0), NLopt (LGPL-2.1 or later), zlib, CLI11\n"
    "(BSD) and nlohmann/json (MIT). It starts chainmail-import, which is under the GPL, as a "
    "separate program.";

std::string help_hint(const CLI::App& app) {
  return "see chainmail" + (app.get_parent() == nullptr ? "" : " " + app.get_name()) + " --help";
}

const CLI::App& chosen(const CLI::App& root) {
  const auto commands = root.get_subcommands();
  return commands.empty() ? root : *commands.front();
}

/// Converts an error of CLI11 to ours. Its text begins with the name of the option or positional argument.
Error usage_error(const CLI::App& root, const CLI::ParseError& error) {
  const std::string text = error.what();
  const std::string name = text.substr(0, text.find_first_of(": "));
  const std::string hint = help_hint(chosen(root));
  if (dynamic_cast<const CLI::RequiredError*>(&error) != nullptr) {
    return {name, "it is missing", hint};
  }
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr) {
    return {name, "its value is missing", hint};
  }
  return {"arguments", text, hint};
}

/// Throws Error for the first argument that belongs to no option and no positional argument.
void refuse_extras(const CLI::App& root) {
  const CLI::App& app = chosen(root);
  for (const CLI::App* with_extras : {&root, &app}) {
    const auto extras = with_extras->remaining();
    const auto found = std::ranges::find_if(extras, [](const std::string& one) { return one != "--"; });
    if (found == extras.end()) {
      continue;
    }
    const std::string& word = *found;
    const bool is_name = found != extras.begin();  // behind `--`
    require(word.size() < 2 || word.front() != '-' || is_name, word, "there is no such option", help_hint(app));
    throw Error(word, with_extras == &root ? "there is no such command" : "unexpected argument", help_hint(app));
  }
}

/// Throws Error if the value of an option is itself an option, because then the value is missing. What has a position
/// may be any name behind `--`.
void refuse_swallowed_options(const CLI::App& app) {
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& value : option->results()) {
      require(option->get_positional() || !value.starts_with("--"), option->get_name(), "its value is missing",
              help_hint(app));
    }
  }
}

/// Returns the arguments, quoted for a shell.
std::string as_typed(int argc, char** argv) {
  std::string line = "chainmail";
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    constexpr const char* plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_./,:=+@%";
    if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) {
      line += ' ' + word;
      continue;
    }
    line += " '";
    for (const char character : word) {
      line += character == '\'' ? "'\\''" : std::string(1, character);
    }
    line += '\'';
  }
  return line;
}

}  // namespace

std::filesystem::path samples_folder() { return program_folder() / DATA_FOLDER "/meshes"; }

void run(int argc, char** argv) {
  CLI::App root("Deforms meshes with the ChainMail family of algorithms.", "chainmail");
  root.set_version_flag("--version", version_in_words("chainmail") + licence, "Print version and licence, and exit");
  root.footer(run_footer);
  root.allow_extras()->require_subcommand(0, 1);
  const std::string typed = as_typed(argc, argv);
  const std::vector<Command> commands{add_generate(root),    add_convert(root),        add_fill(root),
                                      add_repair(root),      add_simplify(root),       add_info(root),
                                      add_deform(root),      add_compare(root, typed), add_calibrate(root),
                                      add_ramp(root, typed), add_completion(root)};
  for (const Command& command : commands) {
    command.app->allow_extras();
  }
  try {
    root.parse(argc, argv);
  } catch (const CLI::Success& asked) {
    std::ostringstream text;
    root.exit(asked, text, text);
    write_file("-", [&](std::ostream& out) { out << text.str(); });
    return;
  } catch (const CLI::ParseError& error) {
    throw usage_error(root, error);
  }
  refuse_swallowed_options(chosen(root));
  refuse_extras(root);
  for (const Command& command : commands) {
    if (command.app->parsed()) {
      command.run();
      return;
    }
  }
  throw Error("command", "no command was given",
              "use generate, convert, fill, repair, simplify, info, deform, compare, calibrate or ramp; see chainmail "
              "--help");
}

}  // namespace chainmail::command_line
