#pragma once

#include <QComboBox>
#include <QLineEdit>
#include <QStackedLayout>
#include <QString>
#include <QToolButton>
#include <QWidget>
#include <vector>

#include "document/document.h"
#include "files/session/softness_presets.h"

namespace chainmail {

class Actions;

/// The user's softness presets, in a file beside the settings. Names are unique and differ from those of built-in
/// presets. Functions throw Error if they fail; then nothing has changed.
class PresetStore {
 public:
  const std::vector<SoftnessPreset>& own() const { return own_; }

  /// Returns the file of the presets.
  static QString file();
  /// Reads the file. Throws if it is damaged; then there are no presets. The next change gives the damaged file another
  /// name.
  void load();
  /// Adds a preset, or replaces the user's preset of this name.
  void save(const SoftnessPreset& preset);
  void remove(const std::string& name);

 private:
  void refresh();
  void write(std::vector<SoftnessPreset> presets);

  std::vector<SoftnessPreset> own_;
};

/// The preset of the softness of all links. Shows and chooses a preset; saves and deletes the user's presets.
class PresetRow : public QWidget {
  Q_OBJECT

 public:
  PresetRow(Document& document, Actions& actions);

 signals:
  /// Emitted when something fails; `sentence` says why and what to do.
  void failed(const QString& sentence);
  /// Emitted after a change that is not visible in the dock.
  void noted(const QString& sentence);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void arrange();
  void addActions();
  void fill();
  void showChosen();
  const SoftnessPreset* chosen() const;
  const SoftnessPreset* chosenOwn() const;
  void choose(int index);
  void takeName();
  void endNaming();
  void saveAs();
  void remove();
  /// Runs `act` and reports an Error if it throws one. Returns true if it succeeded.
  bool attempt(const std::function<void()>& act);

  Document& document_;
  PresetStore store_;
  std::vector<SoftnessPreset> all_;  // in the order of the field: the built-in ones first
  std::string last_;                 // the last chosen name, shown if several presets have equal values
  bool isNaming_ = false;            // the field for a name is shown
  QStackedLayout* fields_;
  QComboBox* field_;
  QLineEdit* name_;
  QToolButton* more_;
  Actions& actions_;
};

}  // namespace chainmail
