#include "window/menus.h"

#include <QActionGroup>
#include <QMenuBar>
#include <QSet>
#include <algorithm>
#include <array>
#include <span>

#include "common/icons.h"
#include "common/theme.h"

namespace chainmail {
namespace {

struct ActionIcon {
  const char* name;
  const char* icon;
};

// By the object name of the action.
constexpr std::array actionIcons{ActionIcon{"openFile", "open"},
                                 ActionIcon{"saveSession", "save"},
                                 ActionIcon{"saveSessionAs", "save"},
                                 ActionIcon{"saveFile", "mesh"},
                                 ActionIcon{"saveShapeA", "shape"},
                                 ActionIcon{"saveShapeB", "shape"},
                                 ActionIcon{"saveShapeC", "shape"},
                                 ActionIcon{"saveShapeD", "shape"},
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
                                 ActionIcon{"showValidRegions", "region"},
                                 ActionIcon{"savePreset", "save"},
                                 ActionIcon{"deletePreset", "close"},
                                 ActionIcon{"showShortcuts", "keyboard"}};

// By the text of the submenu.
constexpr std::array submenuIcons{ActionIcon{"Open recent", "history"},
                                  ActionIcon{"Save deformed mesh", "shape"},
                                  ActionIcon{"Picture", "screenshot"},
                                  ActionIcon{"Record and replay", "record"},
                                  ActionIcon{"Steps of the pass", "stepForward"},
                                  ActionIcon{"Panels", "panels"},
                                  ActionIcon{"Compare with", "difference"},
                                  ActionIcon{"Colour by", "colour"},
                                  ActionIcon{"Colour range", "colour"},
                                  ActionIcon{"Theme", "theme"},
                                  ActionIcon{"Rates over time", "frameRate"},
                                  ActionIcon{"Softness presets", "preset"}};

void addIcon(QAction& action) {
  const bool isMenu = action.menu() != nullptr;
  const QString name = isMenu ? action.text().remove(QLatin1Char('&')) : action.objectName();
  const std::span<const ActionIcon> icons = isMenu ? std::span<const ActionIcon>(submenuIcons) : actionIcons;
  const auto found =
      std::ranges::find_if(icons, [&name](const ActionIcon& one) { return name == QLatin1String(one.name); });
  if (found != icons.end() && action.icon().isNull()) {
    action.setIcon(icon(found->icon));
  }
}

void addIcons(const QMenu& menu) {
  for (QAction* action : menu.actions()) {
    addIcon(*action);
    if (action->menu() != nullptr) {
      addIcons(*action->menu());
    }
  }
}

QChar mnemonicOf(const QString& text) {
  const qsizetype at = text.indexOf(QLatin1Char('&'));
  return at < 0 || at + 1 >= text.size() ? QChar() : text[at + 1].toLower();
}

/// Returns the index of a letter that no other item uses, if possible the first letter of a word; -1 if there is none.
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

void addMnemonics(const QList<QAction*>& actions) {
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
      addMnemonics(action->menu()->actions());
    }
  }
}

}  // namespace

void completeMenus(const QMenuBar& bar) {
  for (const QAction* top : bar.actions()) {
    addIcons(*top->menu());
  }
  addMnemonics(bar.actions());
}

void addThemes(QMenu& menu) {
  auto* themes = menu.addMenu(QStringLiteral("&Theme"));
  auto* group = new QActionGroup(themes);
  const auto add = [&](const char* name, const QString& text, colours::Ground ground, const QString& tip) {
    auto* action = group->addAction(text);
    action->setObjectName(QLatin1String(name));
    action->setCheckable(true);
    action->setChecked(rememberedGround() == ground);
    action->setStatusTip(tip);
    QObject::connect(action, &QAction::triggered, action, [ground] {
      remember(ground);
      applyGround(ground);
    });
    themes->addAction(action);
  };
  add("themeDark", QStringLiteral("&Dark"), colours::Ground::dark, QStringLiteral("Light text on a dark background"));
  add("themeLight", QStringLiteral("&Light"), colours::Ground::light,
      QStringLiteral("Dark text on a light background"));
}

}  // namespace chainmail
