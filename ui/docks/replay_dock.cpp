#include "docks/replay_dock.h"

#include <QFileDialog>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QStyle>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>

#include "common/actions.h"
#include "common/as_path.h"
#include "common/dock_scroll.h"
#include "files/session/moves.h"
#include "files/text/outputs.h"
#include "io/questions.h"

namespace chainmail {
namespace {

constexpr int movesRefreshMilliseconds = 50;
constexpr int standardSpeed = 60;  // moves per second, the rate at which drags are sampled

QString movesFilter() { return QStringLiteral("Recorded moves (*.json)"); }

bool isMove(const Command& command) { return std::holds_alternative<commands::Drag>(command); }

}  // namespace

ReplayDock::ReplayDock(Document& document, QWidget& scene, Jobs& jobs, Actions& actions)
    : document_(document),
      jobs_(jobs),
      film_(document, scene, jobs),
      actions_(actions),
      slider_(new QSlider(Qt::Horizontal)),
      position_(new QLabel),
      speed_(new QComboBox),
      refresh_(this) {
  addActions();
  arrange();
  playing_.setTimerType(Qt::PreciseTimer);
  connect(&playing_, &QTimer::timeout, this, &ReplayDock::playOn);
  refresh_.setSingleShot(true);
  refresh_.setInterval(movesRefreshMilliseconds);
  connect(&refresh_, &QTimer::timeout, this, &ReplayDock::showMoves);
  connect(&document.moves(), &MovePlayer::changed, this, &ReplayDock::scheduleShow);
  connect(&document, &Document::meshChanged, this, [this] {
    if (std::exchange(played_, document_.unsplitMesh()) != document_.unsplitMesh()) {
      setPlaying(false);
    }
  });
  connect(&film_, &Film::failed, this, &ReplayDock::failed);
  connect(&film_, &Film::saved, this, &ReplayDock::saved);
  connect(&film_, &Film::changed, this, &ReplayDock::showMoves);
  showMoves();
}

// Actions.

void ReplayDock::addActions() {
  const auto goes = [this](auto position) {
    return [this, position] {
      setPlaying(false);
      goTo(position(document_.moves().history()));
    };
  };
  const When someBehind([this] { return behind() && !film_.running(); });
  const When someAhead([this] { return ahead() && !film_.running(); });
  const When some([this] { return hasMoves() && !film_.running(); });
  actions_.add("Object", {{"replay", "&Record and replay", "record"}});
  actions_.add(
      "replay",
      {{"replayFirst", "Go to &beginning", "toStart", "Ctrl+Alt+Home", "Shows the object before the first move",
        goes([](const MoveHistory& history) { return history.start(); }), someBehind},
       {"replayBack", "Move b&ack", "stepBack", "Ctrl+Alt+Left", "Goes back by one pass",
        goes([this](const MoveHistory&) { return previousMove(); }), someBehind},
       {"replayPlay", "&Play", "play", "Ctrl+Alt+Space", "Plays the moves by the algorithms of the panels",
        [this] { setPlaying(!playing_.isActive()); }, some, Appears([this] {
          return playing_.isActive() ? Appearance{.text = "&Pause", .icon = "pause"}
                                     : Appearance{.text = "&Play", .icon = "play"};
        })},
       {"replayForward", "Move &forward", "stepForward", "Ctrl+Alt+Right", "Goes forward by one pass",
        goes([this](const MoveHistory&) { return nextMove(); }), someAhead},
       {"replayLast", "Go to &end", "toEnd", "Ctrl+Alt+End", "Shows the object after the last move",
        goes([](const MoveHistory& history) { return history.length(); }), someAhead},
       {},
       {"openMoves", "Open &moves…", "open", "",
        "Opens recorded moves of this mesh; the object returns to rest, ready to play them", [this] { askForMoves(); },
        When([this] { return !film_.running(); })},
       {"saveMoves", "&Save moves…", "save", "",
        "Saves the moves as JSON for chainmail deform --script and chainmail compare --moves",
        [this] { askWhereMoves(); }, some}});
  actions_.add("File", {{"exportFilm", "Export &film…", "movie", "",
                         "Saves a video of all moves: one picture of the panels per move, 60 per second",
                         [this] { askWhereFilm(); }, When([this, some]() -> Available {
                           return Film::canMakeVideos()
                                      ? some.now()
                                      : Available(QStringLiteral("Not available: install ffmpeg to save videos"));
                         })}});
}

// The slider and the state.

void ReplayDock::scheduleShow() {
  if (!refresh_.isActive()) {
    refresh_.start();
  }
}

QString ReplayDock::describe() const {
  const MoveHistory& history = document_.moves().history();
  if (!hasMoves()) {
    return QStringLiteral("No moves yet: everything you do to the object is recorded here");
  }
  return QStringLiteral("move %L1 of %L2")
      .arg(history.passes(history.position()))
      .arg(history.passes(history.length()));
}

void ReplayDock::showMoves() {
  if (wanted_) {
    goTo(*wanted_);
  }
  const MoveHistory& history = document_.moves().history();
  const QSignalBlocker block(slider_);
  slider_->setRange(int(history.start()), int(history.length()));
  slider_->setValue(int(wanted_.value_or(history.position())));
  position_->setText(describe());
  slider_->setEnabled(hasMoves() && !film_.running());
  for (const char* menu : {"replay", "File"}) {  // "File" has the film
    actions_.refreshMenu(QLatin1String(menu));
  }
}

bool ReplayDock::hasMoves() const { return ahead() || behind(); }

bool ReplayDock::behind() const {
  const MoveHistory& history = document_.moves().history();
  return history.position() > history.start();
}

bool ReplayDock::ahead() const {
  const MoveHistory& history = document_.moves().history();
  return history.position() < history.length();
}

std::size_t ReplayDock::nextMove() const {
  const MoveHistory& history = document_.moves().history();
  for (std::size_t i = history.position(); i < history.length(); ++i) {
    if (isMove(history.at(i))) {
      return i + 1;
    }
  }
  return history.length();
}

std::size_t ReplayDock::previousMove() const {
  const MoveHistory& history = document_.moves().history();
  for (std::size_t i = history.position(); i > history.start() + 1; --i) {
    if (isMove(history.at(i - 2))) {
      return i - 1;
    }
  }
  return history.start();
}

/// Goes to a position in the recorded commands. While the solvers are busy, stores it as the next position.
void ReplayDock::goTo(std::size_t position) {
  if (document_.solvers().idle()) {
    wanted_.reset();
    document_.moves().goTo(position);
  } else {
    wanted_ = position;
    scheduleShow();
  }
}

void ReplayDock::setPlaying(bool on) {
  if (!on) {
    playing_.stop();
  } else {
    if (!ahead()) {
      goTo(document_.moves().history().start());
    }
    playing_.start(1000 / speed_->currentData().toInt());
  }
  actions_.refresh();
}

void ReplayDock::playOn() {
  if (!document_.solvers().idle()) {
    return;
  }
  if (!ahead()) {
    setPlaying(false);
  } else {
    document_.moves().goTo(nextMove());
  }
}

// Widgets.

QWidget* ReplayDock::makeTransport() {
  auto* row = new QWidget;
  auto* line = new QHBoxLayout(row);
  line->setContentsMargins(0, 0, 0, 0);
  for (QAction* action : actions_.all({"replayFirst", "replayBack", "replayPlay", "replayForward", "replayLast"})) {
    auto* button = new QToolButton;
    button->setDefaultAction(action);
    button->setToolButtonStyle(Qt::ToolButtonIconOnly);
    line->addWidget(button);
  }
  slider_->setObjectName(QStringLiteral("replaySlider"));
  slider_->setAccessibleName(QStringLiteral("Position in the recorded moves"));
  slider_->setToolTip(
      QStringLiteral("Number of recorded commands that are applied. Moving the slider is one undo step"));
  connect(slider_, &QSlider::valueChanged, this, [this](int value) {
    setPlaying(false);
    goTo(std::size_t(value));
  });
  line->addWidget(slider_, 1);
  return row;
}

void ReplayDock::arrange() {
  speed_->setObjectName(QStringLiteral("replaySpeed"));
  speed_->setAccessibleName(QStringLiteral("Moves per second"));
  speed_->setToolTip(QStringLiteral("Moves played per second; a drag by mouse records at most 60"));
  for (const int moves : {5, 15, 30, 60, 120}) {
    speed_->addItem(QStringLiteral("%1 moves/s").arg(moves), moves);
  }
  speed_->setCurrentIndex(speed_->findData(standardSpeed));
  connect(speed_, &QComboBox::currentIndexChanged, this, [this] {
    if (playing_.isActive()) {
      playing_.start(1000 / speed_->currentData().toInt());
    }
  });
  position_->setObjectName(QStringLiteral("replayPlace"));
  position_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
  auto* content = new QWidget;
  auto* column = new QVBoxLayout(content);
  column->setContentsMargins(9, 4, 9, 6);
  column->setSpacing(4);
  column->addWidget(makeTransport());
  auto* line = new QHBoxLayout;
  line->addWidget(position_, 1);
  line->addWidget(speed_);
  auto* more = new QToolButton;
  more->setObjectName(QStringLiteral("replayMore"));
  more->setText(QStringLiteral("Moves"));
  more->setToolTip(QStringLiteral("Opens and saves moves"));
  more->setMenu(&actions_.menu("replay"));
  more->setPopupMode(QToolButton::InstantPopup);
  line->addWidget(more);
  column->addLayout(line);
  content->setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Fixed);
  setWidget(new DockScroll(content));
}

// Files.

void ReplayDock::askForMoves() {
  const QString path = QFileDialog::getOpenFileName(window(), QStringLiteral("Open moves"), {}, movesFilter());
  if (!path.isEmpty()) {
    openMoves(path);
  }
}

void ReplayDock::askWhereMoves() {
  const QString path = askWhere(*window(), QStringLiteral("Save moves"), {movesFilter()},
                                asFileName(document_.name()) + QStringLiteral("-moves"));
  if (!path.isEmpty()) {
    saveMoves(path);
  }
}

void ReplayDock::askWhereFilm() {
  const QString path = askWhere(*window(), QStringLiteral("Export film"), {QStringLiteral("Video (*.mp4 *.webm)")},
                                asFileName(document_.name()) + QStringLiteral("-moves"));
  if (!path.isEmpty()) {
    saveFilm(path);
  }
}

void ReplayDock::openMoves(const QString& path) {
  setPlaying(false);
  const QString name = QFileInfo(path).fileName();
  jobs_.start(
      Jobs::Kind::load, QStringLiteral("Opening %1").arg(name),
      [this, path, name, mesh = document_.unsplitMesh()](const Progress& progress) -> Jobs::Finish {
        const auto moves = std::make_shared<const std::vector<Command>>(read_moves(asPath(path), mesh, progress));
        return [this, moves, name, mesh] {
          setPlaying(false);
          if (mesh == document_.unsplitMesh()) {
            document_.moves().load(moves, QStringLiteral("open %1").arg(name));
          } else {
            emit failed(QStringLiteral("%1: the object was replaced while the moves were read. Open the moves again")
                            .arg(name));
          }
        };
      });
}

void ReplayDock::saveMoves(const QString& path) {
  document_.moves().noteRelaxation();
  jobs_.start(Jobs::Kind::save, QStringLiteral("Saving %1").arg(QFileInfo(path).fileName()),
              [this, path, mesh = document_.unsplitMesh(),
               moves = document_.moves().history().commands()](const Progress& progress) -> Jobs::Finish {
                write_file(asPath(path), [&](std::ostream& out) { write_moves(out, moves, *mesh, progress); });
                return [this, path] { emit saved(path); };
              });
}

void ReplayDock::saveFilm(const QString& path) {
  setPlaying(false);
  film_.begin(path);
}

}  // namespace chainmail
