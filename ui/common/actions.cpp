#include "common/actions.h"

#include <QActionGroup>
#include <QMenuBar>
#include <QRegularExpression>
#include <QScopedValueRollback>
#include <QSet>

#include "common/icons.h"

namespace chainmail {
namespace {

QChar mnemonicOf(const QString& text) {
  static const QRegularExpression marks(QStringLiteral("(?:[^&]|&&)*&([^&])"));  // "&&" is a real '&'
  const auto found =
      marks.match(text, 0, QRegularExpression::NormalMatch, QRegularExpression::AnchorAtOffsetMatchOption);
  return found.hasMatch() ? found.captured(1)[0].toLower() : QChar();
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

void addMnemonicsTo(const QList<QAction*>& actions) {
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
    static const QRegularExpression marks(QStringLiteral("(&&)|&"));
    QString text = action->text().replace(marks, QStringLiteral("\\1"));
    if (const qsizetype at = freeLetter(text, taken); at >= 0) {
      taken += text[at].toLower();
      action->setText(text.insert(at, QLatin1Char('&')));
    }
  }
  for (const QAction* action : actions) {
    if (action->menu() != nullptr) {
      addMnemonicsTo(action->menu()->actions());
    }
  }
}

}  // namespace

Keys::Keys(const QString& names) : QList(QKeySequence::listFromString(names)) { removeAll(QKeySequence()); }

Actions::Actions(QMainWindow& window, const std::vector<ActionRow>& menus) : QObject(&window), window_(window) {
  add({}, menus);
  for (const auto& [id, menu] : menus_) {
    connect(menu, &QMenu::aboutToShow, this, [this, menu = menu] {
      refresh();
      addMnemonicsTo(menu->actions());  // a text that has changed lost its own
    });
  }
}

void Actions::add(const QString& place, const std::vector<ActionRow>& rows) {
  QWidget* parent = place.isEmpty() ? static_cast<QWidget*>(window_.menuBar()) : &menu(place);
  QActionGroup* choices = nullptr;
  for (const ActionRow& row : rows) {
    if (!row.id.isEmpty() && !row.act.run) {
      QMenu* menu = menus_[row.id] = new QMenu(row.text, parent);
      menu->setObjectName(row.id);
      menu->setIcon(icon(row.icon));
      parent->addAction(menu->menuAction());
      continue;
    }
    auto* action = new QAction(this);
    if (row.id.isEmpty()) {
      action->setSeparator(true);
      parent->addAction(action);
      continue;
    }
    add(place, row, action);
    if (row.isOn.now && !row.act.takesState) {
      choices = choices == nullptr ? new QActionGroup(this) : choices;
      choices->addAction(action);
    }
  }
}

void Actions::add(const QString& place, const ActionRow& row, QAction* action) {
  action->setObjectName(row.id);
  action->setText(row.text.section(QLatin1Char('|'), 0, 0));
  if (row.text.contains(QLatin1Char('|'))) {
    action->setIconText(row.text.section(QLatin1Char('|'), 1));
  }
  action->setShortcuts(row.keys);
  action->setIcon(icon(row.icon));
  action->setCheckable(action->isCheckable() || row.isOn.now);
  if (row.act.run) {
    const auto signal = row.isOn.now && row.act.takesState ? &QAction::toggled : &QAction::triggered;
    connect(action, signal, this, [this, act = row.act.run](bool on) {
      if (!refreshes_) {
        act(on);
      }
    });
    connect(action, signal, this, &Actions::refresh);
  }
  QMenu& in = menu(place);
  in.addAction(action);
  in.setToolTipsVisible(in.toolTipsVisible() || (row.when.now && qobject_cast<QMenu*>(in.parent()) != nullptr));
  window_.addAction(action);
  actions_[row.id] = action;
  made_.push_back({place, row, action});
  const QScopedValueRollback refreshes(refreshes_, true);
  adapt(made_.back());
}

QList<QAction*> Actions::all(const QStringList& ids) const {
  QList<QAction*> all;
  for (const QString& id : ids) {
    all << &(*this)[id];
  }
  return all;
}

void Actions::addMnemonics() const { addMnemonicsTo(window_.menuBar()->actions()); }

void Actions::refresh() { refreshMenu({}); }

/// Setting the state of a switch does not act again.
void Actions::refreshMenu(const QString& menu) {
  if (refreshes_) {
    return;
  }
  const QScopedValueRollback refreshes(refreshes_, true);
  for (Made& one : made_) {
    if (menu.isEmpty() || one.menu == menu) {
      adapt(one);
    }
  }
}

/// The tips of an action that is not available say why.
void Actions::adapt(Made& one) {
  const ActionRow& row = one.row;
  const Available available = row.when.now ? row.when.now() : Available(true);
  const Appearance appearance = row.appears.now ? row.appears.now() : Appearance{.visible = one.action->isVisible()};
  if (!appearance.text.isEmpty() && appearance.text != one.text) {  // else it keeps its mnemonic
    one.text = appearance.text;
    one.action->setText(appearance.text);
  }
  if (*appearance.icon != 0 && QLatin1String(appearance.icon) != one.icon) {
    one.icon = QLatin1String(appearance.icon);
    one.action->setIcon(icon(appearance.icon));
  }
  one.action->setVisible(appearance.visible);
  if (row.when.now) {
    one.action->setEnabled(available.is);
  }
  if (row.isOn.now) {
    one.action->setChecked(row.isOn.now());
  }
  const QString tip = !available.why.isEmpty() ? available.why : appearance.tip.isEmpty() ? row.tip : appearance.tip;
  const QString names = one.action->shortcut().toString(QKeySequence::NativeText);
  one.action->setStatusTip(tip);
  one.action->setToolTip(plainText(*one.action) + (names.isEmpty() ? QString() : QStringLiteral(" (%1)").arg(names)) +
                         QLatin1Char('\n') + tip);
}

QString menuText(QString shown) { return shown.replace(QLatin1Char('&'), QLatin1String("&&")); }

QString plainText(const QAction& action) {
  static const QRegularExpression marks(QStringLiteral("&(.)"));  // of a mnemonic, and before a real '&'
  return action.text().replace(marks, QStringLiteral("\\1")).remove(QStringLiteral("…"));
}

}  // namespace chainmail
