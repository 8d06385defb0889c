#include "docks/preset_row.h"

#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QSettings>
#include <QStandardItemModel>
#include <QStyleOption>
#include <algorithm>
#include <utility>

#include "common/actions.h"
#include "common/as_path.h"
#include "common/text.h"
#include "document/edits.h"
#include "files/text/limits.h"
#include "files/text/outputs.h"
#include "mesh/error.h"
#include "report/table/format.h"

namespace chainmail {
namespace {

/// Earlier versions kept the presets in the settings. Qt (6.4) empties the file of the settings without a word when the
/// disk is full, so presets have a file of their own.
std::string earlierText() { return QSettings().value(QStringLiteral("softnessPresets")).toString().toStdString(); }

/// A button with a menu, but without the arrow of one: its text says as much. A style sheet would hide changes of the
/// theme from it.
class PlainMenuButton : public QToolButton {
 protected:
  void initStyleOption(QStyleOptionToolButton* option) const override {
    QToolButton::initStyleOption(option);
    option->features.setFlag(QStyleOptionToolButton::HasMenu, false);
  }
};

}  // namespace

QString PresetStore::file() {
  return QFileInfo(QSettings().fileName()).dir().filePath(QStringLiteral("softness-presets.json"));
}

void PresetStore::load() {
  own_.clear();
  if (QFile::exists(file())) {
    own_ = read_presets(asPath(file()));
  } else if (const std::string text = earlierText(); !text.empty()) {
    own_ = read_presets(text, "settings");
  }
}

/// Reads what another window may have changed. A file that cannot be read gets another name.
void PresetStore::refresh() {
  try {
    load();
  } catch (const Error&) {
    QFile::rename(file(), file() + QStringLiteral(".damaged"));
  }
}

void PresetStore::save(const SoftnessPreset& preset) {
  const std::string where = "preset '" + preset.name + "'";
  if (const std::string fault = fault_of_name(preset.name); !fault.empty()) {
    throw Error(where, "this name is not allowed", fault);
  }
  if (std::ranges::count(built_in_presets(), preset.name, &BuiltInPreset::name) > 0) {
    throw Error(where, "a built-in preset has this name", "choose another name");
  }
  refresh();
  std::vector<SoftnessPreset> presets = own_;
  if (const auto there = std::ranges::find(presets, preset.name, &SoftnessPreset::name); there != presets.end()) {
    *there = preset;
  } else if (presets.size() < limits::presets) {
    presets.push_back(preset);
  } else {
    throw Error("presets", "there cannot be more than " + std::to_string(presets.size()), "delete some of them first");
  }
  write(std::move(presets));
}

void PresetStore::remove(const std::string& name) {
  refresh();
  std::vector<SoftnessPreset> presets = own_;
  std::erase_if(presets, [&](const SoftnessPreset& preset) { return preset.name == name; });
  write(std::move(presets));
}

void PresetStore::write(std::vector<SoftnessPreset> presets) {
  QDir().mkpath(QFileInfo(file()).path());
  write_file(asPath(file()), [&](std::ostream& out) { write_presets(out, presets); });
  own_ = std::move(presets);
}

PresetRow::PresetRow(Document& document, Actions& actions)
    : document_(document),
      fields_(new QStackedLayout),
      field_(new QComboBox),
      name_(new QLineEdit),
      more_(new PlainMenuButton),
      actions_(actions) {
  addActions();
  arrange();
  connect(field_, &QComboBox::activated, this, &PresetRow::choose);
  connect(name_, &QLineEdit::returnPressed, this, &PresetRow::takeName);
  connect(&document, &Document::softnessChanged, this, &PresetRow::showChosen);
  try {
    store_.load();
  } catch (const Error& error) {
    // Queued, because nothing is connected yet.
    QMetaObject::invokeMethod(
        this, [this, what = QString::fromStdString(error.what())] { emit failed(what); }, Qt::QueuedConnection);
  }
  fill();
}

void PresetRow::arrange() {
  field_->setObjectName(QStringLiteral("preset"));
  field_->setAccessibleName(QStringLiteral("Softness preset"));
  field_->setToolTip(QStringLiteral("Sets the softness of all links, as one undo step; the kind of energy stays"));
  field_->setFocusPolicy(Qt::StrongFocus);  // the wheel scrolls the dock, without changing the field
  field_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  field_->setMinimumContentsLength(8);
  name_->setObjectName(QStringLiteral("presetName"));
  name_->setAccessibleName(QStringLiteral("Name of the preset"));
  name_->setToolTip(QStringLiteral("Enter saves the name, Esc cancels"));
  name_->setPlaceholderText(QStringLiteral("Name, then Enter"));
  name_->setMaxLength(int(limits::preset_name_bytes));
  more_->setObjectName(QStringLiteral("presetMore"));
  more_->setText(QStringLiteral("⋯"));
  more_->setAccessibleName(QStringLiteral("Save or delete presets"));
  more_->setToolTip(more_->accessibleName());
  more_->setPopupMode(QToolButton::InstantPopup);
  more_->setMenu(&actions_.menu("presets"));
  more_->setFocusPolicy(Qt::TabFocus);
  for (QObject* one : std::initializer_list<QObject*>{field_, name_}) {
    one->installEventFilter(this);
  }
  auto* label = new QLabel(QStringLiteral("Preset"));
  label->setBuddy(field_);
  label->setToolTip(field_->toolTip());
  fields_->addWidget(field_);
  fields_->addWidget(name_);
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(6);
  row->addWidget(label);
  row->addLayout(fields_, 1);
  row->addWidget(more_);
}

void PresetRow::addActions() {
  actions_.add("Object", {{"presets", "Softness &presets", "preset"}});
  actions_.add(
      "presets",
      {{"savePreset", "&Save as preset…", "save", "", "Saves the softness of all links under a name",
        [this] { saveAs(); }, When([this] {
          const SoftnessPreset* one = chosen();
          return one == nullptr
                     ? QString()
                     : QStringLiteral("These values are already saved as '%1'").arg(QString::fromStdString(one->name));
        })},
       {"deletePreset", "&Delete preset", "close", "", "Deletes the selected preset; the object keeps its softness",
        [this] { remove(); }, When([this] {
          return chosenOwn() != nullptr ? QString()
                 : chosen() == nullptr  ? "The values match no preset: select one of your presets"
                                        : "This preset is built in: select one of your presets";
        })}});
}

/// Lists 'Custom', which cannot be chosen, the built-in presets and the user's presets.
void PresetRow::fill() {
  all_.clear();
  field_->clear();
  field_->addItem(QStringLiteral("Custom"), -1);
  field_->setItemData(0, QStringLiteral("The values match no preset"), Qt::ToolTipRole);
  qobject_cast<QStandardItemModel*>(field_->model())->item(0)->setEnabled(false);
  const auto list = [this](const SoftnessPreset& preset, const QString& help) {
    field_->addItem(QString::fromStdString(preset.name), int(all_.size()));
    field_->setItemData(field_->count() - 1, sentence(text(report::region_in_words(preset.softness))) + help,
                        Qt::ToolTipRole);
    all_.push_back(preset);
  };
  for (const BuiltInPreset& one : built_in_presets()) {
    list({std::string(one.name), one.softness}, QStringLiteral(": %1").arg(text(one.reason)));
  }
  if (!store_.own().empty()) {
    field_->insertSeparator(field_->count());
  }
  for (const SoftnessPreset& one : store_.own()) {
    list(one, {});
  }
  showChosen();
}

void PresetRow::showChosen() {
  const LinkSoftness& now = document_.softness();
  auto found = std::ranges::find(all_, SoftnessPreset{last_, now});
  if (found == all_.end()) {
    found = std::ranges::find(all_, now, &SoftnessPreset::softness);
  }
  const int preset = found == all_.end() ? -1 : int(found - all_.begin());
  field_->setCurrentIndex(field_->findData(preset));
  actions_.refresh();
}

const SoftnessPreset* PresetRow::chosen() const {
  const int preset = field_->count() == 0 ? -1 : field_->currentData().toInt();
  return preset < 0 ? nullptr : &all_[std::size_t(preset)];
}

const SoftnessPreset* PresetRow::chosenOwn() const {
  const SoftnessPreset* one = chosen();
  return one == nullptr || one - all_.data() < std::ssize(built_in_presets()) ? nullptr : one;
}

void PresetRow::choose(int index) {
  const SoftnessPreset preset = all_[std::size_t(field_->itemData(index).toInt())];
  last_ = preset.name;
  edits::setSoftness(document_, preset.softness, QStringLiteral("preset %1").arg(QString::fromStdString(preset.name)));
  showChosen();
}

/// Replaces the list by a field for the name, until the user presses Enter or Esc.
void PresetRow::saveAs() {
  isNaming_ = true;
  name_->clear();
  fields_->setCurrentWidget(name_);
  for (QWidget* above = parentWidget(); above != nullptr; above = above->parentWidget()) {
    if (above->isHidden()) {
      above->show();  // called from the menu while the dock is closed
    }
  }
  name_->setFocus();
}

void PresetRow::takeName() {
  const std::string name = name_->text().trimmed().toStdString();
  if (attempt([&] { store_.save({name, document_.softness()}); })) {
    last_ = name;
    endNaming();
    fill();
  }
}

void PresetRow::endNaming() {
  isNaming_ = false;
  fields_->setCurrentWidget(field_);
}

void PresetRow::remove() {
  const std::string name = chosen()->name;
  if (attempt([&] { store_.remove(name); })) {
    endNaming();  // in case the user was naming one
    fill();
    emit noted(QStringLiteral("Deleted preset '%1'").arg(QString::fromStdString(name)));
  }
}

bool PresetRow::attempt(const std::function<void()>& act) {
  try {
    act();
    return true;
  } catch (const Error& error) {
    emit failed(QString::fromStdString(error.what()));
    return false;
  }
}

bool PresetRow::eventFilter(QObject* watched, QEvent* event) {
  if (watched == field_ && event->type() == QEvent::Wheel && !field_->hasFocus()) {
    event->ignore();
    return true;
  }
  if (watched == name_ && (event->type() == QEvent::ShortcutOverride || event->type() == QEvent::KeyPress) &&
      dynamic_cast<QKeyEvent*>(event)->key() == Qt::Key_Escape) {
    event->accept();  // Esc cancels the name and nothing else
    if (event->type() == QEvent::KeyPress) {
      endNaming();
      field_->setFocus();
    }
    return true;
  }
  if (watched == name_ && event->type() == QEvent::FocusOut && isNaming_) {
    const Qt::FocusReason reason = dynamic_cast<QFocusEvent*>(event)->reason();
    if (reason != Qt::ActiveWindowFocusReason && reason != Qt::PopupFocusReason) {
      endNaming();
    }
  }
  return QWidget::eventFilter(watched, event);
}

}  // namespace chainmail
