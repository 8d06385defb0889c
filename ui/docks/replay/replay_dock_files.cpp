// The actions of the replay dock, and the files it reads and writes.

#include <QAction>
#include <QFileDialog>
#include <QFileInfo>

#include "common/as_path.h"
#include "common/icons.h"
#include "docks/replay/replay_dock.h"
#include "files/session/moves.h"
#include "files/text/outputs.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

QString movesFilter() { return QStringLiteral("Recorded moves (*.json)"); }
}  // namespace

QAction* ReplayDock::add(const char* name, const QString& text, const char* drawing, const QKeySequence& key,
                         const QString& help, std::function<void()> act) {
  QAction* action = menu_->addAction(text);
  action->setObjectName(QLatin1String(name));
  action->setIcon(icon(drawing));
  action->setShortcut(key);
  action->setStatusTip(help);
  action->setToolTip(key.isEmpty() ? help : QStringLiteral("%1 (%2)").arg(help, key.toString()));
  connect(action, &QAction::triggered, this, [this, act = std::move(act)] {
    if (!film_.running()) {
      act();
    }
  });
  return action;
}

void ReplayDock::makeActions() {
  const auto stopAndGo = [this](std::size_t position) {
    setPlaying(false);
    goTo(position);
  };
  first_ =
      add("replayFirst", QStringLiteral("To the &beginning"), "toStart", QKeySequence(QStringLiteral("Ctrl+Alt+Home")),
          QStringLiteral("The object at rest, as before the first move"), [=] { stopAndGo(0); });
  back_ = add("replayBack", QStringLiteral("A move b&ack"), "stepBack", QKeySequence(QStringLiteral("Ctrl+Alt+Left")),
              QStringLiteral("The object as before the last pass"), [=, this] { stopAndGo(previousMove()); });
  play_ = add("replayPlay", QStringLiteral("&Play"), "play", QKeySequence(QStringLiteral("Ctrl+Alt+Space")),
              QStringLiteral("The moves one after another, by the algorithms of the panels"),
              [this] { setPlaying(!playing_.isActive()); });
  forward_ =
      add("replayForward", QStringLiteral("A move &on"), "stepForward", QKeySequence(QStringLiteral("Ctrl+Alt+Right")),
          QStringLiteral("The next pass"), [=, this] { stopAndGo(nextMove()); });
  last_ = add("replayLast", QStringLiteral("To the &end"), "toEnd", QKeySequence(QStringLiteral("Ctrl+Alt+End")),
              QStringLiteral("The object after the last move"), [=, this] { stopAndGo(document_.tape().length()); });
  menu_->addSeparator();
  add("openMoves", QStringLiteral("Open &moves…"), "open", {},
      QStringLiteral("A script of moves of this mesh; the object goes to rest, and they lie ahead"),
      [this] { askForMoves(); });
  save_ =
      add("saveMoves", QStringLiteral("&Save moves…"), "save", {},
          QStringLiteral("A script, for chainmail deform --script and compare --moves"), [this] { askWhereMoves(); });
  menu_->addSeparator();
  pictures_ = add("savePictures", QStringLiteral("Save as p&ictures…"), "picture", {},
                  QStringLiteral("A numbered picture of the panels after every move, into a folder"),
                  [this] { askWhereFilm(false); });
  video_ = add("saveVideo", QStringLiteral("Save as &video…"), "movie", {},
               Film::canMakeVideos() ? QStringLiteral("A film of the panels, a picture a move, at 60 a second")
                                     : QStringLiteral("Not here: the program ffmpeg was not found"),
               [this] { askWhereFilm(true); });
}

void ReplayDock::askForMoves() {
  const QString path = QFileDialog::getOpenFileName(window(), QStringLiteral("Open moves"), {}, movesFilter());
  if (!path.isEmpty()) {
    openMoves(path);
  }
}

void ReplayDock::askWhereMoves() {
  const QString path =
      QFileDialog::getSaveFileName(window(), QStringLiteral("Save moves"), QStringLiteral("moves.json"), movesFilter());
  if (!path.isEmpty()) {
    saveMoves(path);
  }
}

void ReplayDock::askWhereFilm(bool video) {
  const QString path =
      video ? QFileDialog::getSaveFileName(window(), QStringLiteral("Save as video"), QStringLiteral("moves.mp4"),
                                           QStringLiteral("Video (*.mp4 *.webm)"))
            : QFileDialog::getExistingDirectory(window(), QStringLiteral("Save pictures into a folder"));
  if (!path.isEmpty()) {
    saveFilm(path);
  }
}

void ReplayDock::openMoves(const QString& path) {
  setPlaying(false);
  const QString name = QFileInfo(path).fileName();
  jobs_.start(
      Jobs::Kind::load, QStringLiteral("Opening %1").arg(name),
      [this, path, name, mesh = document_.mesh()](const Progress& progress) -> Jobs::Finish {
        const auto moves = std::make_shared<const std::vector<Command>>(read_moves(asPath(path), *mesh, progress));
        return [this, moves, name, mesh] {
          setPlaying(false);
          film_.cancel();
          if (mesh == document_.mesh()) {
            document_.loadMoves(moves, QStringLiteral("open %1").arg(name));
          } else {
            emit failed(
                QStringLiteral("%1: the object was replaced while the moves were read; open them again").arg(name));
          }
        };
      });
}

void ReplayDock::saveMoves(const QString& path) {
  document_.noteRelaxation();
  jobs_.start(Jobs::Kind::save, QStringLiteral("Saving %1").arg(QFileInfo(path).fileName()),
              [this, path, mesh = document_.mesh(),
               moves = document_.tape().commands()](const Progress& progress) -> Jobs::Finish {
                write_file(asPath(path), [&](std::ostream& out) { write_moves(out, moves, *mesh, progress); });
                return [this, path] { emit saved(path); };
              });
}

void ReplayDock::saveFilm(const QString& path) {
  setPlaying(false);
  film_.begin(path);
}

}  // namespace chainmail
