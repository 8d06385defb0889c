#include "docks/replay/replay_dock.h"

#include <QAction>
#include <QHBoxLayout>
#include <QProgressBar>
#include <QStyle>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>

#include "common/icons.h"

namespace chainmail {
namespace {

constexpr int refreshMilliseconds = 50;
constexpr int standardSpeed = 60;  // moves a second, as a hand's are sampled

bool isMove(const Command& command) { return std::holds_alternative<commands::Drag>(command); }

}  // namespace

ReplayDock::ReplayDock(Document& document, QWidget& scene, Jobs& jobs)
    : QDockWidget(QStringLiteral("Record and replay")),
      document_(document),
      jobs_(jobs),
      film_(document, scene),
      menu_(new QMenu(QStringLiteral("&Record and replay"), this)),
      slider_(new QSlider(Qt::Horizontal)),
      place_(new QLabel),
      speed_(new QComboBox),
      filmBar_(makeFilmBar()),
      refresh_(this) {
  setObjectName(QStringLiteral("replayDock"));
  makeActions();
  arrange();
  playing_.setTimerType(Qt::PreciseTimer);
  connect(&playing_, &QTimer::timeout, this, &ReplayDock::playOn);
  refresh_.setSingleShot(true);
  refresh_.setInterval(refreshMilliseconds);
  connect(&refresh_, &QTimer::timeout, this, &ReplayDock::showTape);
  connect(&document, &Document::tapeChanged, this, &ReplayDock::scheduleShow);
  connect(&document, &Document::meshChanged, this, [this] { setPlaying(false); });
  listenToFilm();
  showTape();
}

void ReplayDock::scheduleShow() {
  if (!refresh_.isActive()) {
    refresh_.start();
  }
}

QString ReplayDock::describe() const {
  const Tape& tape = document_.tape();
  if (tape.length() == 0) {
    return QStringLiteral("Nothing was done to this object yet: all that is done will stand here");
  }
  return QStringLiteral("move %L1 of %L2").arg(tape.passes(tape.position())).arg(tape.passes(tape.length()));
}

void ReplayDock::showTape() {
  if (wanted_) {
    goTo(*wanted_);
  }
  const Tape& tape = document_.tape();
  const QSignalBlocker block(slider_);
  slider_->setRange(0, int(tape.length()));
  slider_->setValue(int(wanted_.value_or(tape.position())));
  place_->setText(describe());
  const bool some = tape.length() > 0, filming = film_.running();
  const bool behind = tape.position() > 0, ahead = tape.position() < tape.length();
  for (QAction* action : {first_, back_}) {
    action->setEnabled(behind && !filming);
  }
  for (QAction* action : {forward_, last_}) {
    action->setEnabled(ahead && !filming);
  }
  for (QAction* action : {play_, save_, pictures_}) {
    action->setEnabled(some && !filming);
  }
  video_->setEnabled(some && !filming && Film::canMakeVideos());
  slider_->setEnabled(some && !filming);
  filmBar_->setVisible(filming);
}

std::size_t ReplayDock::nextMove() const {
  const Tape& tape = document_.tape();
  for (std::size_t i = tape.position(); i < tape.length(); ++i) {
    if (isMove(tape.at(i))) {
      return i + 1;
    }
  }
  return tape.length();
}

std::size_t ReplayDock::previousMove() const {
  const Tape& tape = document_.tape();
  for (std::size_t i = tape.position(); i > 1; --i) {
    if (isMove(tape.at(i - 2))) {
      return i - 1;
    }
  }
  return 0;
}

/// What the solvers have no time for yet waits, and the last wish counts.
void ReplayDock::goTo(std::size_t position) {
  if (document_.idle()) {
    wanted_.reset();
    document_.goTo(position);
  } else {
    wanted_ = position;
    scheduleShow();
  }
}

void ReplayDock::setPlaying(bool on) {
  play_->setText(on ? QStringLiteral("&Pause") : QStringLiteral("&Play"));
  play_->setIcon(icon(on ? "pause" : "play"));
  if (!on) {
    playing_.stop();
    return;
  }
  if (document_.tape().position() == document_.tape().length()) {
    goTo(0);
  }
  playing_.start(1000 / speed_->currentData().toInt());
}

void ReplayDock::playOn() {
  if (!document_.idle()) {
    return;
  }
  if (document_.tape().position() == document_.tape().length()) {
    setPlaying(false);
  } else {
    document_.goTo(nextMove());
  }
}

QWidget* ReplayDock::makeTransport() {
  auto* row = new QWidget;
  auto* line = new QHBoxLayout(row);
  line->setContentsMargins(0, 0, 0, 0);
  for (QAction* action : {first_, back_, play_, forward_, last_}) {
    auto* button = new QToolButton;
    button->setDefaultAction(action);
    button->setToolButtonStyle(Qt::ToolButtonIconOnly);
    line->addWidget(button);
  }
  slider_->setObjectName(QStringLiteral("replaySlider"));
  slider_->setAccessibleName(QStringLiteral("Place in what was done"));
  slider_->setToolTip(
      QStringLiteral("How many of the commands have been carried out; going there is one step of undo"));
  connect(slider_, &QSlider::valueChanged, this, [this](int value) {
    setPlaying(false);
    goTo(std::size_t(value));
  });
  line->addWidget(slider_, 1);
  return row;
}

void ReplayDock::arrange() {
  speed_->setObjectName(QStringLiteral("replaySpeed"));
  speed_->setAccessibleName(QStringLiteral("Moves a second"));
  speed_->setToolTip(QStringLiteral("How many moves are played a second; the hand makes 60 at most"));
  for (const int moves : {5, 15, 30, 60, 120}) {
    speed_->addItem(QStringLiteral("%1 moves/s").arg(moves), moves);
  }
  speed_->setCurrentIndex(speed_->findData(standardSpeed));
  connect(speed_, &QComboBox::currentIndexChanged, this, [this] {
    if (playing_.isActive()) {
      playing_.start(1000 / speed_->currentData().toInt());
    }
  });
  place_->setObjectName(QStringLiteral("replayPlace"));
  place_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
  auto* content = new QWidget;
  auto* column = new QVBoxLayout(content);
  column->setContentsMargins(9, 4, 9, 6);
  column->setSpacing(4);
  column->addWidget(makeTransport());
  auto* line = new QHBoxLayout;
  line->addWidget(place_, 1);
  line->addWidget(speed_);
  auto* more = new QToolButton;
  more->setObjectName(QStringLiteral("replayMore"));
  more->setText(QStringLiteral("Moves and films"));
  more->setToolTip(QStringLiteral("Save and open moves, save them as pictures or video"));
  more->setMenu(menu_);
  more->setPopupMode(QToolButton::InstantPopup);
  line->addWidget(more);
  column->addLayout(line);
  column->addWidget(filmBar_);
  content->setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Fixed);
  setWidget(content);
}

QWidget* ReplayDock::makeFilmBar() {
  auto* bar = new QWidget;
  auto* line = new QHBoxLayout(bar);
  line->setContentsMargins(0, 0, 0, 0);
  filmed_ = new QProgressBar;
  filmed_->setObjectName(QStringLiteral("filmProgress"));
  filmed_->setFormat(QStringLiteral("Filming: picture %v of %m"));
  auto* cancel = new QToolButton;
  cancel->setObjectName(QStringLiteral("cancelFilm"));
  cancel->setText(QStringLiteral("Cancel"));
  cancel->setToolTip(QStringLiteral("Ends the film; nothing of it is kept"));
  connect(cancel, &QToolButton::clicked, this, [this] { film_.cancel(); });
  line->addWidget(filmed_, 1);
  line->addWidget(cancel);
  return bar;
}

void ReplayDock::listenToFilm() {
  connect(&film_, &Film::progressed, this, [this](int done, int pictures) {
    filmed_->setRange(0, pictures);
    filmed_->setValue(done);
  });
  connect(&film_, &Film::failed, this, &ReplayDock::failed);
  connect(&film_, &Film::saved, this, &ReplayDock::saved);
  connect(&film_, &Film::changed, this, &ReplayDock::showTape);
}

}  // namespace chainmail
