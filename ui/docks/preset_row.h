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

/// Which preset the softness of all links is, if it is one; and the choice of another, with the user's own kept,
/// renamed, deleted, and exchanged as files.
class PresetRow : public QWidget {
  Q_OBJECT

 public:
  explicit PresetRow(Document& document);

  /// What can be done with presets, for a menu of the window's.
  QMenu& menu() { return *menu_; }
  /// Asks for a name to save the present values under.
  void save() { save_->trigger(); }
  void importPath(const QString& path);
  void exportPath(const QString& path);

 signals:
  /// It could not be done: one sentence.
  void failed(const QString& sentence);
  /// What was done, where it does not show.
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
  /// Runs what may throw; says whether it did not.
  bool attempt(const std::function<void()>& act);

  Document& document_;
  PresetStore store_;
  std::vector<SoftnessPreset> all_;  // as the field lists them, first those built in
  std::string last_;                 // the name of the one chosen last: of several that are equal, it is shown
  Naming naming_ = Naming::none;
  std::string renamed_;  // which one gets the name that is typed; another may be chosen meanwhile
  QStackedLayout* fields_;
  QComboBox* field_;
  QLineEdit* name_;
  QToolButton* more_;
  QMenu* menu_;
  QAction *save_ = nullptr, *rename_ = nullptr, *remove_ = nullptr, *export_ = nullptr;
};

}  // namespace chainmail
