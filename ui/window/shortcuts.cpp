#include "window/shortcuts.h"

#include <QMainWindow>
#include <QMenu>
#include <QMenuBar>
#include <QSet>
#include <QSettings>
#include <algorithm>
#include <functional>

namespace chainmail {
namespace {

QString keyOf(const QString& action) { return QStringLiteral("shortcuts/") + action; }

bool canHaveKeys(const QAction& action) {
  return !action.objectName().isEmpty() && !action.objectName().startsWith(QLatin1String("qt_")) &&
         !action.isSeparator() && action.menu() == nullptr;
}

/// Visits the actions of a menu and its submenus, each with its path.
void walk(const QList<QAction*>& actions, const QString& place,
          const std::function<void(QAction*, const QString&)>& visit) {
  for (QAction* action : actions) {
    const QString here = place.isEmpty() ? plainText(*action) : place + QStringLiteral(" › ") + plainText(*action);
    if (action->menu() != nullptr) {
      walk(action->menu()->actions(), here, visit);
    } else {
      visit(action, here);
    }
  }
}

}  // namespace

QString plainText(const QAction& action) {
  QString text = action.text();
  text.remove(QLatin1Char('&')).remove(QStringLiteral("…"));
  return text;
}

void Shortcuts::adopt() {
  const auto all = entries();
  for (const Entry& entry : all) {
    if (!defaultKeys_.contains(entry.action->objectName())) {
      take(*entry.action);
    }
  }
  const QSettings settings;
  const auto byUser = [&settings](const QAction& action) { return settings.contains(keyOf(action.objectName())); };
  QSet<QKeySequence> given;
  for (const Entry& entry : all) {
    if (byUser(*entry.action)) {
      const auto keys = entry.action->shortcuts();
      given += QSet(keys.begin(), keys.end());
    }
  }
  for (const Entry& entry : all) {
    if (!byUser(*entry.action) && given.contains(entry.action->shortcut())) {
      set(*entry.action, {});
    }
  }
}

void Shortcuts::take(QAction& action) {
  const QString name = action.objectName();
  defaultKeys_[name] = action.shortcuts();
  const QString words = plainText(action);
  if (action.toolTip() == words || action.toolTip() == action.iconText()) {
    tipsOurs_ += name;
  }
  const QSettings settings;
  if (settings.contains(keyOf(name))) {
    action.setShortcuts(
        QKeySequence::listFromString(settings.value(keyOf(name)).toString(), QKeySequence::PortableText));
  }
  showKeys(action);
}

std::vector<Shortcuts::Entry> Shortcuts::entries() const {
  std::vector<Entry> entries;
  QSet<const QAction*> seen;
  const auto add = [&](QAction* action, const QString& place) {
    if (canHaveKeys(*action) && !seen.contains(action)) {
      seen += action;
      entries.push_back({action, place});
    }
  };
  walk(window_.menuBar()->actions(), {}, add);
  for (QAction* action : window_.findChildren<QAction*>()) {
    add(action, plainText(*action));
  }
  return entries;
}

QString Shortcuts::place(const QAction& action) const {
  const auto all = entries();
  const auto found = std::ranges::find(all, &action, &Entry::action);
  return found == all.end() ? plainText(action) : found->place;
}

QKeySequence Shortcuts::defaultKeys(const QAction& action) const {
  return defaultKeys_.value(action.objectName()).value(0);
}

QAction* Shortcuts::owner(const QKeySequence& keys, const QAction& but) const {
  for (const Entry& entry : entries()) {
    if (entry.action != &but && entry.action->shortcuts().contains(keys)) {
      return entry.action;
    }
  }
  return nullptr;
}

QString Shortcuts::assign(QAction& action, const QKeySequence& keys) {
  const auto& standards = defaultKeys_[action.objectName()];
  const bool back = keys == defaultKeys(action);
  const QList<QKeySequence> wanted = back ? standards : keys.isEmpty() ? QList<QKeySequence>() : QList{keys};
  for (const QKeySequence& one : wanted) {
    if (const QAction* other = owner(one, action)) {
      return QStringLiteral("%1 belongs to '%2'. Press other keys, or change the keys of that action first.")
          .arg(one.toString(QKeySequence::NativeText), place(*other));
    }
  }
  set(action, wanted);
  QSettings settings;
  if (back) {
    settings.remove(keyOf(action.objectName()));
  } else {
    settings.setValue(keyOf(action.objectName()), QKeySequence::listToString(wanted, QKeySequence::PortableText));
  }
  emit changed();
  return {};
}

void Shortcuts::resetAll() {
  QSettings().remove(QStringLiteral("shortcuts"));
  for (const Entry& entry : entries()) {
    set(*entry.action, defaultKeys_.value(entry.action->objectName()));
  }
  emit changed();
}

void Shortcuts::set(QAction& action, const QList<QKeySequence>& keys) {
  action.setShortcuts(keys);
  showKeys(action);
}

/// Shows the keys of an action in its tool tip, which tool bar buttons show.
void Shortcuts::showKeys(QAction& action) {
  if (tipsOurs_.contains(action.objectName())) {
    const QString keys = action.shortcut().toString(QKeySequence::NativeText);
    QString tip = plainText(action);
    tip += keys.isEmpty() ? QString() : QStringLiteral(" (%1)").arg(keys);
    tip += action.statusTip().isEmpty() ? QString() : QStringLiteral("\n") + action.statusTip();
    action.setToolTip(tip);
  }
}

}  // namespace chainmail
