#pragma once

#include <QAction>
#include <QMap>
#include <QObject>
#include <vector>

class QMainWindow;

namespace chainmail {

/// The keyboard shortcuts of all named actions of a window: the defaults and the user's own. The settings store the
/// latter under the object names of the actions.
class Shortcuts : public QObject {
  Q_OBJECT

 public:
  explicit Shortcuts(QMainWindow& window) : window_(window) {}

  /// Adds the actions made since the last call and gives them the user's keys. An action loses a default key that the
  /// user has given to another action.
  void adopt();

  struct Entry {
    QAction* action;
    QString place;  // path in the menus: "Edit › Undo"
  };
  /// Returns all actions that can have keys, in the order of the menus; actions outside menus come last.
  std::vector<Entry> entries() const;
  QString place(const QAction& action) const;

  QKeySequence defaultKeys(const QAction& action) const;
  /// Gives an action other keys, or none. Returns an empty string if it succeeds. If the keys belong to another action,
  /// changes nothing and returns a sentence that says so.
  QString assign(QAction& action, const QKeySequence& keys);
  QString reset(QAction& action) { return assign(action, defaultKeys(action)); }
  void resetAll();

 signals:
  void changed();

 private:
  void take(QAction& action);
  void set(QAction& action, const QList<QKeySequence>& keys);
  void showKeys(QAction& action);
  QAction* owner(const QKeySequence& keys, const QAction& but) const;

  QMainWindow& window_;
  QMap<QString, QList<QKeySequence>> defaultKeys_;  // default keys, by object name
  QSet<QString> tipsOurs_;                          // actions whose tool tips this class makes
};

/// Returns the text of an action without its mnemonic and ellipsis.
QString plainText(const QAction& action);

}  // namespace chainmail
