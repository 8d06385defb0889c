#pragma once

#include <QAction>
#include <QComboBox>
#include <QLineEdit>
#include <QMenu>
#include <QStackedLayout>
#include <QToolButton>
#include <QWidget>
#include <vector>

#include "docks/preset_store.h"
#include "document/document.h"

namespace chainmail {

/// The preset of the softness of all links. Shows and chooses a preset; saves, renames, deletes, imports and exports
/// the user's presets.
class PresetRow : public QWidget {
  Q_OBJECT

 public:
  explicit PresetRow(Document& document);

  /// Returns the actions on presets, for a menu of the window.
  QMenu& menu() { return *menu_; }
  /// Asks for a name and saves the current values under it.
  void save() { save_->trigger(); }
  void importPath(const QString& path);
  void exportPath(const QString& path);

 signals:
  /// Emitted when something fails; `sentence` says why and what to do.
  void failed(const QString& sentence);
  /// Emitted after a change that is not visible in the dock.
  void noted(const QString& sentence);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  enum class Naming { none, save, rename };

  void arrange();
  void addActions();
  QAction* add(const char* name, const QString& text, const QString& help, void (PresetRow::*act)());
  void fill();
  void showChosen();
  void adaptActions();
  const SoftnessPreset* chosen() const;
  const SoftnessPreset* chosenOwn() const;
  void choose(int index);
  void ask(Naming naming, const QString& name);
  void takeName();
  void endNaming();
  void saveAs();
  void rename();
  void remove();
  void import();
  void exportAll();
  /// Runs `act` and reports an Error if it throws one. Returns true if it succeeded.
  bool attempt(const std::function<void()>& act);

  Document& document_;
  PresetStore store_;
  std::vector<SoftnessPreset> all_;  // in the order of the field: the built-in ones first
  std::string last_;                 // the last chosen name, shown if several presets have equal values
  Naming naming_ = Naming::none;
  std::string renamed_;  // the preset to rename; the user may choose another one meanwhile
  QStackedLayout* fields_;
  QComboBox* field_;
  QLineEdit* name_;
  QToolButton* more_;
  QMenu* menu_;
  QAction *save_ = nullptr, *rename_ = nullptr, *remove_ = nullptr, *export_ = nullptr;
};

}  // namespace chainmail
