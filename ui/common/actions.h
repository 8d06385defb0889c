#pragma once

#include <QAction>
#include <QKeySequence>
#include <QMainWindow>
#include <QMenu>
#include <concepts>
#include <functional>
#include <map>
#include <utility>
#include <vector>

namespace chainmail {

/// The keys of an action, by name: "Ctrl+S", or "+; =" for two of them.
struct Keys : QList<QKeySequence> {
  Keys(const char* names = "") : Keys(QString::fromLatin1(names)) {}
  Keys(const QString& names);
  Keys(QKeySequence::StandardKey key) : QList({QKeySequence(key)}) {}
};

/// What an action does. A row with IsOn is a switch if the function takes its new state, and a choice otherwise.
struct Effect {
  Effect() = default;
  template <std::invocable Function>
  Effect(Function function) : run([function](bool) { function(); }) {}
  template <std::invocable<bool> Function>
  Effect(Function function) : run(std::move(function)), takesState(true) {}

  std::function<void(bool)> run;
  bool takesState = false;
};

/// Says that an action is available, or that it is not and why. Without a reason, the tips stay as they are.
struct Available {
  Available(const char*) = delete;  // it would be a bool
  Available(bool available) : is(available) {}
  Available(const QString& reason) : is(reason.isEmpty()), why(reason) {}

  bool is;
  QString why;
};

/// How an action appears now, where it does not always look as its row says. What is empty is as in the row.
struct Appearance {
  QString text = {}, tip = {};
  const char* icon = "";
  bool visible = true;
};

/// What a row says anew each time: a function that is called in refresh().
template <class Value>
struct Now {
  Now() = default;
  explicit Now(std::function<Value()> function) : now(std::move(function)) {}

  std::function<Value()> now;
};
using IsOn = Now<bool>;           // makes a row a switch, or one of several choices: its state
using When = Now<Available>;      // when the action is available; else always
using Appears = Now<Appearance>;  // how the action appears; else always as the row says

/// A row of a table of actions. Without `act`, it is a submenu; without `id`, a separator.
struct ActionRow {
  ActionRow() = default;
  /// `more` are IsOn, When and Appears.
  template <class... More>
  ActionRow(QString name, QString words, const char* drawing = "", Keys shortcuts = "", QString help = {},
            Effect does = {}, More... more)
      : id(std::move(name)),
        text(std::move(words)),
        icon(drawing),
        keys(std::move(shortcuts)),
        tip(std::move(help)),
        act(std::move(does)) {
    (set(std::move(more)), ...);
  }

  QString id;             // the object name; of a submenu also the place of its rows
  QString text;           // in menus; after a bar '|' a shorter one for buttons
  const char* icon = "";  // a name in icons.cpp
  Keys keys;
  QString tip;
  Effect act;
  IsOn isOn;
  When when;
  Appears appears;

 private:
  void set(IsOn one) { isOn = std::move(one); }
  void set(When one) { when = std::move(one); }
  void set(Appears one) { appears = std::move(one); }
};

/// The actions of a window, made from rows. Its menus have them in the order in which they are added. Their predicates
/// are evaluated after each action and in refresh(), which follows the signals of what they read.
class Actions : public QObject {
  Q_OBJECT

 public:
  /// `menus` are those of the menu bar. The window has all actions, so that keys work without the menus.
  Actions(QMainWindow& window, const std::vector<ActionRow>& menus);

  /// Adds rows to the menu with this id; an empty one is the menu bar. Its choices exclude each other.
  void add(const QString& menu, const std::vector<ActionRow>& rows);
  /// Adds an action that exists as this row describes it.
  void add(const QString& menu, const ActionRow& row, QAction* action);

  QAction& operator[](const QString& id) const { return *actions_.at(id); }
  QList<QAction*> all(const QStringList& ids) const;
  QMenu& menu(const QString& id) const { return *menus_.at(id); }
  /// Gives every item of all menus a mnemonic, unique in its menu, so that all can be reached with Alt and letters.
  void addMnemonics() const;
  void refresh();
  /// Evaluates the actions of one menu only, for what changes many times in a second.
  void refreshMenu(const QString& menu);

 private:
  struct Made {
    QString menu;
    ActionRow row;
    QAction* action;
    QString text = {};  // the last text that was not the row's
    QString icon = {};
  };

  static void adapt(Made& one);

  QMainWindow& window_;
  std::vector<Made> made_;
  std::map<QString, QAction*> actions_;
  std::map<QString, QMenu*> menus_;
  bool refreshes_ = false;
};

/// Returns the text of an item that shows this text, also where it has a '&'.
QString menuText(QString shown);
/// Returns the text of an action without its mnemonic and the dots of a question.
QString plainText(const QAction& action);

}  // namespace chainmail
