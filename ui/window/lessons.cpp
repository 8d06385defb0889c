#include "window/lessons.h"

#include <QDir>
#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include "common/actions.h"
#include "common/colours.h"
#include "common/text.h"
#include "drawing/camera.h"
#include "files/session/session.h"
#include "io/samples.h"
#include "io/sessions.h"
#include "panels/panel_area.h"
#include "window/bars.h"
#include "window/docks.h"
#include "window/lesson_bar.h"
#include "window/main_window.h"
#include "window/show_menu.h"

namespace chainmail {
namespace {

constexpr float markSize = 13, markEdge = 4;          // pixels; the edge is the background around the mark, both sides
constexpr double smallestMark = 2, largestMark = 10;  // diameter of the mark of one of many elements, pixels
constexpr double markShare = 0.5, spatialMarkShare = 0.2;  // that diameter, in link lengths

constexpr std::array tools{"drag", "cut", "pin", "measure", "select"};

QString listOf(const QStringList& names) { return names.join(QStringLiteral(", ")); }

QString dockName(const DockEntry& entry) { return QString::fromLatin1(entry.id).remove(QStringLiteral("Dock")); }

QStringList dockNames() {
  QStringList names;
  for (const DockEntry& entry : dockEntries()) {
    names << dockName(entry);
  }
  return names;
}

QStringList colourNames() {
  QStringList names;
  for (const ColourModeInfo& mode : colourModes()) {
    names << text(mode.name);
  }
  return names;
}

QStringList toolNames() { return {tools.begin(), tools.end()}; }

}  // namespace

void LessonHandle::draw(const Canvas& canvas) {
  const auto dragged = player_.dragged();
  if (dragged.size() == 1) {
    canvas.painter.drawElements(canvas.scene, dragged, canvas.scene.background, markSize + markEdge);
    canvas.painter.drawElements(canvas.scene, dragged, colours::lit, markSize);
  } else if (!dragged.empty()) {
    const Mesh& mesh = *canvas.frame.mesh;
    const double pixels = (mesh.space_dimension == 3 ? spatialMarkShare : markShare) * mesh.mean_link_length;
    const auto diameter = float(std::clamp(pixels / canvas.unitsPerPixel, smallestMark, largestMark));
    canvas.painter.drawElements(canvas.scene, dragged, colours::lit, diameter);
  }
}

Lessons::Lessons(MainWindow& window, Propagation& propagation, const Sessions& sessions, Actions& actions)
    : QObject(&window),
      window_(window),
      player_(window.document(), propagation),
      actions_(actions),
      handle_(player_),
      bar_(nullptr) {
  addActions();
  // In this order: the bar reads the actions.
  for (const auto change : {&LessonPlayer::openChanged, &LessonPlayer::stepChanged, &LessonPlayer::playsChanged}) {
    connect(&player_, change, &actions_, &Actions::refresh);
  }
  bar_ = new LessonBar(player_, actions_["lessonBack"], actions_["lessonNext"], actions_["lessonFollowing"],
                       actions_["lessonClose"]);
  connect(&player_, &LessonPlayer::openChanged, this, &Lessons::leave);
  connect(&sessions, &Sessions::opened, this, &Lessons::start);
  connect(&player_, &LessonPlayer::stepChanged, this, &Lessons::showStep);
  connect(&player_, &LessonPlayer::movesBegin, this, &Lessons::fitBefore);
  connect(&player_, &LessonPlayer::movesEnd, this, &Lessons::fitAfter);
  connect(&player_, &LessonPlayer::playsChanged, &window.area(), &PanelArea::refresh);
  window.area().addOverlay(handle_);
}

void Lessons::addActions() {
  actions_.add("Help", {{"lessons", "&Lessons", "lesson"}});
  for (const LessonFile& lesson : lessonFiles()) {
    const auto number = &lesson - lessonFiles().data() + 1;
    actions_.add("lessons", {{QStringLiteral("lesson%1").arg(number),
                              QStringLiteral("&%1 %2").arg(number).arg(QString::fromUtf8(lesson.title)), "play", "",
                              "Opens this lesson: short captions, and Next plays each step",
                              [this, &lesson] { open(lesson.file); }}});
  }
  actions_.add(
      "lessons",
      {{},
       {"lessonNext", "&Next step", "stepForward", "PgDown",
        "Plays the next step of the lesson; during a step, goes to its end; after the last step, opens the next lesson",
        [this] { goOn(); },
        When([this] { return player_.isOpen() && (!player_.isLast() || player_.plays() || neighbour(1) != nullptr); })},
       {"lessonBack", "Step &back", "stepBack", "PgUp",
        "Restores the end of the step before; at the first step, opens the lesson before", [this] { goBack(); },
        When([this] { return player_.isOpen() && (player_.step() > 0 || neighbour(-1) != nullptr); })},
       {"lessonFollowing", "Next lesson", "", "", "Opens the lesson after the present one", [this] { openFollowing(); },
        When([this] { return neighbour(1) != nullptr; }), Appears([this] {
          const LessonFile* next = neighbour(1);
          return Appearance{.text = next != nullptr ? "Next lesson: " + menuText(QString::fromUtf8(next->title))
                                                    : "Next lesson"};
        })},
       {"lessonClose", "&Close lesson", "close", "", "Closes the lesson; the object stays as it is",
        [this] { player_.close(); }, When([this] { return player_.isOpen(); })}});
}

/// Returns the bundled lesson that is so many places after the present one; null if there is none.
const LessonFile* Lessons::neighbour(int steps) const {
  const auto files = lessonFiles();
  const auto isPresent = [this](const LessonFile& one) { return player_.lesson().title == one.title; };
  const auto present = std::ranges::find_if(files, isPresent);
  const std::ptrdiff_t wanted = present - files.begin() + steps;
  const bool exists = present != files.end() && wanted >= 0 && wanted < std::ssize(files);
  return player_.isOpen() && exists ? &files[std::size_t(wanted)] : nullptr;
}

void Lessons::openFollowing() {
  if (const LessonFile* next = neighbour(1)) {
    open(next->file);
  }
}

void Lessons::goOn() { player_.isLast() && !player_.plays() ? openFollowing() : player_.next(); }

/// From the first step, leads to the end of the lesson before, like the pages of a talk.
void Lessons::goBack() {
  const LessonFile* before = neighbour(-1);
  if (player_.step() > 0 || before == nullptr) {
    player_.back();
  } else {
    opensAtEnd_ = true;
    open(before->file);
  }
}

void Lessons::open(const char* file) {
  const QString folder = lessonsFolder();
  if (folder.isEmpty()) {
    window_.messages().say(QStringLiteral(
        "The lessons were not found next to the program. Install it again, or open a lesson by File > Open"));
    return;
  }
  window_.openFile(QDir(folder).filePath(QLatin1String(file)));
}

void Lessons::start() {
  const bool atEnd = std::exchange(opensAtEnd_, false);
  if (player_.isOpen()) {
    warnOfUnknownNames();
    atEnd ? player_.goToEnd() : player_.start();
  }
}

/// When a lesson closes, hides the dock that it has opened, and the next object has the colours and the look that the
/// user had chosen before.
void Lessons::leave() {
  if (player_.isOpen()) {
    colourBefore_ = colourBefore_.value_or(window_.colouring().mode());
    return;
  }
  chooseDock({});
  if (!window_.document().lesson().session && colourBefore_) {
    window_.colouring().setMode(*std::exchange(colourBefore_, {}));
    window_.showMenu().forgetShown();
  }
}

// What the window shows at a step.

QString Lessons::nameOf(std::string LessonStep::*which) const { return QString::fromStdString(player_.name(which)); }

/// Before the moves of a step, the views make room for them, so that they need not jump meanwhile. They stay as they
/// are if the user, or the session, has chosen a view.
void Lessons::fitBefore() {
  if (window_.area().fits()) {
    std::vector<QVector3D> reach;
    const FrameSpace space(*window_.document().mesh());
    std::ranges::transform(player_.reach(), std::back_inserter(reach),
                           [&space](const Point& point) { return asVector(space.into(point)); });
    window_.area().fitWith(std::move(reach));
  }
}

void Lessons::fitAfter(bool playedOneByOne) {
  if (window_.area().fits() && !(playedOneByOne && window_.area().showsAll())) {
    window_.area().fit();
  }
}

void Lessons::showStep() {
  const QString colour = nameOf(&LessonStep::colour);
  for (const ColourModeInfo& mode : colourModes()) {
    if (colour == text(mode.name)) {
      window_.colouring().setMode(mode.mode);
    }
  }
  window_.showMenu().show(nameOf(&LessonStep::show));
  chooseDock(nameOf(&LessonStep::dock));
  if (const QString tool = nameOf(&LessonStep::tool); toolNames().contains(tool)) {
    actions_["tool" + tool.left(1).toUpper() + tool.mid(1)].trigger();
  }
}

/// Shows a dock, and hides the one that an earlier step has opened.
void Lessons::chooseDock(const QString& name) {
  if (name == dock_) {
    return;
  }
  if (QDockWidget* before = dock(dock_)) {
    before->hide();
  }
  dock_.clear();
  QDockWidget* wanted = dock(name);
  if (wanted != nullptr && !wanted->isVisible()) {
    dock_ = name;
    bringUp(*wanted);
  }
}

QDockWidget* Lessons::dock(const QString& name) const {
  const auto& all = window_.docks().all();
  const auto found = std::find_if(all.begin(), all.end(), [&](const QDockWidget* one) {
    return one->objectName() == name + QStringLiteral("Dock");
  });
  return name.isEmpty() || found == all.end() ? nullptr : *found;
}

/// Names that the window does not know have no effect. Their author should hear of it.
void Lessons::warnOfUnknownNames() {
  struct Kind {
    const char* key;
    std::string LessonStep::*name;
    QStringList known;
  };
  const std::array kinds{Kind{"colour", &LessonStep::colour, colourNames()},
                         Kind{"show", &LessonStep::show, ShowMenu::names()},
                         Kind{"dock", &LessonStep::dock, dockNames()}, Kind{"tool", &LessonStep::tool, toolNames()}};
  const auto& steps = player_.lesson().steps;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    for (const auto& [key, name, known] : kinds) {
      const QString value = QString::fromStdString(steps[i].*name);
      if (!value.isEmpty() && !known.contains(value)) {
        window_.messages().warn(QStringLiteral("%1: step %2: '%3' is '%4', which is not known; use one of: %5")
                                    .arg(QString::fromStdString(player_.lesson().title))
                                    .arg(i + 1)
                                    .arg(QLatin1String(key), value, listOf(known)));
        return;
      }
    }
  }
}

}  // namespace chainmail
