#pragma once

#include <QAction>
#include <QMap>
#include <QObject>
#include <vector>

class QMainWindow;

namespace chainmail {

/// The keys of all named actions of a window: what they are by default, and what the user made of them, which is
/// remembered under the actions' names.
class Shortcuts : public QObject {
  Q_OBJECT

 public:
  explicit Shortcuts(QMainWindow& window) : window_(window) {}

  /// Takes in the actions that have come since the last time, with the user's keys for them. Where the user gave a key
  /// to one action that is another's default, that other has none.
  void adopt();

  struct Entry {
    QAction* action;
    QString place;  // where it is found, as "Edit › Undo"
  };
  /// All actions that can be given keys, in the order of the menus; those that stand in none come last.
  std::vector<Entry> entries() const;
  QString place(const QAction& action) const;

  QKeySequence standard(const QAction& action) const;
  /// Gives an action other keys, or none. Where they belong to another action nothing is changed, and the answer is a
  /// sentence that says so; else it is empty.
  QString assign(QAction& action, const QKeySequence& keys);
  QString reset(QAction& action) { return assign(action, standard(action)); }
  void resetAll();

 signals:
  void changed();

 private:
  void take(QAction& action);
  void set(QAction& action, const QList<QKeySequence>& keys);
  void showKeys(QAction& action);
  QAction* owner(const QKeySequence& keys, const QAction& but) const;

  QMainWindow& window_;
  QMap<QString, QList<QKeySequence>> standard_;  // by the actions' names
  QSet<QString> tipsOurs_;                       // whose tool tips nobody else wrote
};

/// The words of an action, without its mnemonic.
QString plainText(const QAction& action);

}  // namespace chainmail
