#include "window/menus.h"

#include <QDockWidget>
#include <QMainWindow>
#include <QMenu>
#include <QMenuBar>
#include <QSet>

#include "common/icons.h"

namespace chainmail {
namespace {

struct ActionIcon {
  const char* action;
  const char* icon;
};

constexpr std::array actionIcons{ActionIcon{"openFile", "open"},
                                 ActionIcon{"saveSession", "save"},
                                 ActionIcon{"saveSessionAs", "save"},
                                 ActionIcon{"saveFile", "mesh"},
                                 ActionIcon{"saveShapeA", "shape"},
                                 ActionIcon{"saveShapeB", "shape"},
                                 ActionIcon{"saveShapeC", "shape"},
                                 ActionIcon{"saveShapeD", "shape"},
                                 ActionIcon{"saveWarpedA", "warped"},
                                 ActionIcon{"saveWarpedB", "warped"},
                                 ActionIcon{"saveWarpedC", "warped"},
                                 ActionIcon{"saveWarpedD", "warped"},
                                 ActionIcon{"savePicture", "screenshot"},
                                 ActionIcon{"copyPicture", "copy"},
                                 ActionIcon{"quit", "quit"},
                                 ActionIcon{"undo", "undo"},
                                 ActionIcon{"redo", "redo"},
                                 ActionIcon{"giveUp", "giveUp"},
                                 ActionIcon{"resetObject", "resetObject"},
                                 ActionIcon{"resetStiffness", "resetStiffness"},
                                 ActionIcon{"unpinAll", "unpin"},
                                 ActionIcon{"fitView", "fit"},
                                 ActionIcon{"linkCameras", "link"},
                                 ActionIcon{"linkColours", "colour"},
                                 ActionIcon{"linkMarks", "select"},
                                 ActionIcon{"showHistoryDock", "history"},
                                 ActionIcon{"showReport", "report"},
                                 ActionIcon{"showToolsDock", "tools"},
                                 ActionIcon{"showMeshDock", "mesh"},
                                 ActionIcon{"showStiffnessDock", "stiffness"},
                                 ActionIcon{"showRelaxationDock", "relaxation"},
                                 ActionIcon{"showFrameRateDock", "frameRate"},
                                 ActionIcon{"showValidRegions", "region"},
                                 ActionIcon{"savePreset", "save"},
                                 ActionIcon{"renamePreset", "file"},
                                 ActionIcon{"deletePreset", "close"},
                                 ActionIcon{"importPresets", "open"},
                                 ActionIcon{"exportPresets", "copy"},
                                 ActionIcon{"showSizeTest", "grow"},
                                 ActionIcon{"showPropagation", "propagation"},
                                 ActionIcon{"showReplay", "record"},
                                 ActionIcon{"showShortcuts", "keyboard"},
                                 ActionIcon{"showHints", "hints"}};

/// Menus in menus, by what they are called.
constexpr std::array menuIcons{ActionIcon{"Open recent", "history"},
                               ActionIcon{"Save deformed mesh", "shape"},
                               ActionIcon{"Save warped picture", "warped"},
                               ActionIcon{"Picture", "screenshot"},
                               ActionIcon{"Record and replay", "record"},
                               ActionIcon{"Steps of the pass", "stepForward"},
                               ActionIcon{"Panels", "panels"},
                               ActionIcon{"Compare with", "difference"},
                               ActionIcon{"Colour by", "colour"},
                               ActionIcon{"Theme", "theme"},
                               ActionIcon{"Rates over time", "frameRate"},
                               ActionIcon{"Presets of softness", "preset"}};

void nameDocks(QMainWindow& window) {
  for (const QDockWidget* dock : window.findChildren<QDockWidget*>()) {
    QAction* toggle = dock->toggleViewAction();
    QString name = dock->objectName();
    if (toggle->objectName().isEmpty() && !name.isEmpty()) {
      name[0] = name[0].toUpper();
      toggle->setObjectName(QStringLiteral("show") + name);
    }
    if (toggle->statusTip().isEmpty()) {
      toggle->setStatusTip(QStringLiteral("Shows or hides the dock '%1'").arg(dock->windowTitle()));
    }
  }
}

void giveIcons(const QMenu& menu) {
  for (QAction* action : menu.actions()) {
    const QString words = action->text().remove(QLatin1Char('&'));
    for (const ActionIcon& one : menuIcons) {
      if (action->menu() != nullptr && words == QLatin1String(one.action) && action->icon().isNull()) {
        action->setIcon(icon(one.icon));
      }
    }
  }
}

QChar mnemonicOf(const QString& text) {
  const qsizetype at = text.indexOf(QLatin1Char('&'));
  return at < 0 || at + 1 >= text.size() ? QChar() : text[at + 1].toLower();
}

/// A letter that is free, rather the first of a word.
qsizetype freeLetter(const QString& text, const QSet<QChar>& taken) {
  for (const bool first : {true, false}) {
    for (qsizetype i = 0; i < text.size(); ++i) {
      const bool begins = i == 0 || text[i - 1].isSpace();
      if (text[i].isLetterOrNumber() && (begins || !first) && !taken.contains(text[i].toLower())) {
        return i;
      }
    }
  }
  return -1;
}

void giveMnemonics(const QList<QAction*>& actions) {
  QSet<QChar> taken;
  QList<QAction*> without;
  for (QAction* action : actions) {
    const QChar own = mnemonicOf(action->text());
    if (!own.isNull() && !taken.contains(own)) {
      taken += own;
    } else if (!action->isSeparator()) {
      without << action;
    }
  }
  for (QAction* action : without) {
    QString text = action->text().remove(QLatin1Char('&'));
    if (const qsizetype at = freeLetter(text, taken); at >= 0) {
      taken += text[at].toLower();
      action->setText(text.insert(at, QLatin1Char('&')));
    }
  }
  for (const QAction* action : actions) {
    if (action->menu() != nullptr) {
      giveMnemonics(action->menu()->actions());
    }
  }
}

}  // namespace

void completeMenus(QMainWindow& window) {
  nameDocks(window);
  for (const ActionIcon& one : actionIcons) {
    auto* action = window.findChild<QAction*>(QLatin1String(one.action));
    if (action != nullptr && action->icon().isNull()) {
      action->setIcon(icon(one.icon));
    }
  }
  for (const QAction* top : window.menuBar()->actions()) {
    giveIcons(*top->menu());
  }
  giveMnemonics(window.menuBar()->actions());
}

}  // namespace chainmail
