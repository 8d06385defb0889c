#include <QStandardPaths>

#include "cli/chainmail_program.h"
#include "program.h"

namespace chainmail::test_completion {

using namespace chainmail::test;

namespace {

// Each script loads the completion script "$1" and prints what the shell makes of the typed line "$2".

/// bash completes by the function that the script registers; without an answer it completes names of files.
constexpr const char* in_bash = R"(
source "$1"
COMP_WORDS=($2)
COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
_chainmail
[[ ${#COMPREPLY[@]} -gt 0 ]] || mapfile -t COMPREPLY < <(compgen -f -- "${COMP_WORDS[COMP_CWORD]}")
echo "${COMPREPLY[@]}"
)";

/// zsh completes only what is typed, so the line is typed into a shell in a terminal, with a tab and with a key that
/// prints the line.
constexpr const char* in_zsh = R"(
zmodload zsh/zpty
zpty typed "zsh -f -i"
zpty -w typed "PS1=; autoload -Uz compinit; compinit -u -d $PWD/dump; source $1"
zpty -w typed "show() { print -r -- \$BUFFER > $PWD/line; print do''ne }; zle -N show; bindkey '^P' show; print rea''dy"
zpty -r typed text '*ready*'
zpty -w -n typed "$2"$'\t\x10'
zpty -r typed text '*done*'
zpty -d typed
cat line
)";

constexpr const char* in_fish = "source $argv[1]; complete -C $argv[2]";

struct Shell {
  const char* name;
  const char* script;
};
constexpr Shell shells[]{{"bash", in_bash}, {"zsh", in_zsh}, {"fish", in_fish}};

struct Typed {
  const char* line;
  const char* completed;
};
constexpr Typed lines[]{{"chainmail de", "deform"},
                        {"chainmail deform --algorithm natur", "natural-queue"},
                        {"chainmail simplify --elem", "--elements"},
                        {"chainmail compare --again", "--against"},
                        {"chainmail compare --against phy", "physics"},
                        {"chainmail generate tetr", "tetra"},
                        {"chainmail completion fis", "fish"},
                        {"chainmail info obje", "object.obj"},
                        {"chainmail compare object.obj sec", "second.obj"}};

}  // namespace

/// Tests `chainmail completion` in the shells themselves.
class CompletionCommandTest : public QObject {
  Q_OBJECT

 private slots:
  void completes_data();
  void completes();
  void refused();
};

void CompletionCommandTest::completes_data() {
  QTest::addColumn<QString>("shell");
  QTest::addColumn<QString>("script");
  QTest::addColumn<QString>("line");
  QTest::addColumn<QString>("completed");
  for (const Shell& shell : shells) {
    for (const Typed& typed : lines) {
      QTest::addRow("%s: %s", shell.name, typed.line) << shell.name << shell.script << typed.line << typed.completed;
    }
  }
}

void CompletionCommandTest::completes() {
  QFETCH(QString, shell);
  QFETCH(QString, script);
  QFETCH(QString, line);
  QFETCH(QString, completed);
  if (QStandardPaths::findExecutable(shell).isEmpty()) {
    QSKIP(qPrintable(shell + " is not installed"));
  }
  const Program program;
  program.write("object.obj", "v 0 0 0\n");
  program.write("second.obj", "v 0 0 0\n");
  const auto made = program.run({"completion", shell});
  QVERIFY2(made.code == 0 && made.error.isEmpty(), made.error);
  program.write("completion", made.out);
  QProcess process;
  process.setWorkingDirectory(program.path("."));
  QStringList arguments{"-c", script};
  if (shell != "fish") {
    arguments << "test";  // $0
  }
  process.start(shell, arguments << program.path("completion") << line);
  QVERIFY(process.waitForFinished(60'000));
  const QString answer = QString::fromUtf8(process.readAllStandardOutput());
  QVERIFY2(answer.contains(completed), qPrintable(answer + QString::fromUtf8(process.readAllStandardError())));
}

void CompletionCommandTest::refused() {
  const Program program;
  check_refused(program, "completion tcsh", "SHELL: there is no completion for 'tcsh'");
  check_refused(program, "completion", "SHELL: it is missing");
}

CHAINMAIL_TEST(CompletionCommandTest)

}  // namespace chainmail::test_completion

#include "test_completion.moc"
