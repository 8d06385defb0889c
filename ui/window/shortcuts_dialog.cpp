#include "window/shortcuts_dialog.h"

#include <QHBoxLayout>
#include <QHeaderView>
#include <QKeyEvent>
#include <QVBoxLayout>

#include "common/colours.h"
#include "common/icons.h"

namespace chainmail {
namespace {

enum Column { actionColumn, keysColumn, effectColumn };
constexpr QSize dialogSize(760, 560);

QString shown(const QKeySequence& keys) { return keys.toString(QKeySequence::NativeText); }

void describe(QWidget& widget, const char* name, const QString& accessible, const QString& tip) {
  widget.setObjectName(QLatin1String(name));
  widget.setAccessibleName(accessible);
  widget.setToolTip(tip);
}

}  // namespace

ShortcutsDialog::ShortcutsDialog(Shortcuts& shortcuts, QWidget* parent)
    : QDialog(parent),
      shortcuts_(shortcuts),
      search_(new QLineEdit),
      list_(new QTreeWidget),
      whose_(new QLabel),
      keys_(new QKeySequenceEdit),
      none_(new QPushButton(QStringLiteral("&None"))),
      reset_(new QPushButton(QStringLiteral("&Reset"))),
      resetAll_(new QPushButton(QStringLiteral("Reset &all"))),
      answer_(new QLabel) {
  setObjectName(QStringLiteral("shortcutsDialog"));
  setWindowTitle(QStringLiteral("Keyboard shortcuts"));
  resize(dialogSize);
  makeList();
  auto* column = new QVBoxLayout(this);
  column->addWidget(search_);
  column->addWidget(list_, 1);
  column->addLayout(makeEditor());
  column->addWidget(answer_);
  connect(&shortcuts_, &Shortcuts::changed, this, [this] {
    if (isVisible()) {
      fill();
    }
  });
}

void ShortcutsDialog::makeList() {
  describe(*search_, "shortcutSearch", QStringLiteral("Search the actions"),
           QStringLiteral("Shows only the actions whose name, effect or keys contain these words"));
  search_->setPlaceholderText(QStringLiteral("Search actions, effects or keys"));
  search_->setClearButtonEnabled(true);
  search_->addAction(icon("search"), QLineEdit::LeadingPosition);
  search_->installEventFilter(this);
  describe(*list_, "shortcutList", QStringLiteral("Actions and their keys"),
           QStringLiteral("Select an action to change its keys. Enter moves to the field for keys"));
  list_->setHeaderLabels({QStringLiteral("Action"), QStringLiteral("Keys"), QStringLiteral("Effect")});
  list_->setRootIsDecorated(false);
  list_->setAlternatingRowColors(true);
  list_->setUniformRowHeights(true);
  list_->header()->setStretchLastSection(true);
  connect(search_, &QLineEdit::textChanged, this, &ShortcutsDialog::filter);
  connect(list_, &QTreeWidget::currentItemChanged, this, &ShortcutsDialog::showChosen);
  connect(list_, &QTreeWidget::itemActivated, keys_, [this] { keys_->setFocus(); });
}

QLayout* ShortcutsDialog::makeEditor() {
  describe(*keys_, "shortcutKeys", QStringLiteral("Keys of the action"),
           QStringLiteral("Press the new keys of the action; they are set at once"));
  describe(*none_, "shortcutNone", QStringLiteral("No keys"), QStringLiteral("Removes the keys of the action"));
  describe(*reset_, "shortcutReset", QStringLiteral("Reset the keys of the action"), QString());
  describe(*resetAll_, "shortcutResetAll", QStringLiteral("Reset the keys of all actions"),
           QStringLiteral("Restores the default keys of all actions"));
  whose_->setBuddy(keys_);
  whose_->setMinimumWidth(200);
  answer_->setObjectName(QStringLiteral("shortcutAnswer"));
  answer_->setWordWrap(true);
  for (QPushButton* button : {none_, reset_, resetAll_}) {
    button->setAutoDefault(false);
  }
  auto* row = new QHBoxLayout;
  row->addWidget(whose_);
  row->addWidget(keys_, 1);
  row->addWidget(none_);
  row->addWidget(reset_);
  row->addSpacing(16);
  row->addWidget(resetAll_);
  keys_->installEventFilter(this);  // QKeySequenceEdit waits 1 s for more keys before its signal
  connect(none_, &QPushButton::clicked, this, [this] { showAnswer(shortcuts_.assign(*chosen(), {})); });
  connect(reset_, &QPushButton::clicked, this, [this] { showAnswer(shortcuts_.reset(*chosen())); });
  connect(resetAll_, &QPushButton::clicked, this, [this] {
    shortcuts_.resetAll();
    showAnswer({});
  });
  return row;
}

void ShortcutsDialog::showEvent(QShowEvent* event) {
  shortcuts_.adopt();
  fill();
  list_->resizeColumnToContents(actionColumn);
  list_->resizeColumnToContents(keysColumn);
  search_->setFocus();
  QDialog::showEvent(event);
}

/// In the search field, the arrow keys and Enter move the focus to the list. In the field for keys, Esc does this, and
/// all other keys except Tab become the new shortcut.
bool ShortcutsDialog::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() != QEvent::KeyPress) {
    return QDialog::eventFilter(watched, event);
  }
  const auto& press = static_cast<const QKeyEvent&>(*event);
  const int key = press.key();
  if (watched == search_ && (key == Qt::Key_Down || key == Qt::Key_Up || key == Qt::Key_Return)) {
    list_->setFocus();
    return true;
  }
  if (watched == keys_ && key == Qt::Key_Escape) {
    list_->setFocus();
    return true;
  }
  if (watched == keys_ && key != Qt::Key_Tab && key != Qt::Key_Backtab) {
    take(press);
    return true;
  }
  return QDialog::eventFilter(watched, event);
}

void ShortcutsDialog::fill() {
  const QAction* before = chosen();
  {
    const QSignalBlocker block(list_);
    list_->clear();
    for (const auto& entry : shortcuts_.entries()) {
      QStringList keys;
      for (const QKeySequence& one : entry.action->shortcuts()) {
        keys << shown(one);
      }
      auto* item =
          new QTreeWidgetItem(list_, {entry.place, keys.join(QStringLiteral(", ")), entry.action->statusTip()});
      item->setIcon(actionColumn, entry.action->icon());
      item->setToolTip(effectColumn, entry.action->statusTip());
      item->setData(actionColumn, Qt::UserRole, QVariant::fromValue<QObject*>(entry.action));
      if (entry.action == before) {
        list_->setCurrentItem(item);
      }
    }
  }
  filter();
}

void ShortcutsDialog::filter() {
  const QStringList words = search_->text().split(QLatin1Char(' '), Qt::SkipEmptyParts);
  QTreeWidgetItem* first = nullptr;
  for (int i = 0; i < list_->topLevelItemCount(); ++i) {
    QTreeWidgetItem* item = list_->topLevelItem(i);
    const QString all = item->text(actionColumn) + QLatin1Char(' ') + item->text(keysColumn) + QLatin1Char(' ') +
                        item->text(effectColumn);
    const bool fits = std::all_of(words.begin(), words.end(),
                                  [&all](const QString& word) { return all.contains(word, Qt::CaseInsensitive); });
    item->setHidden(!fits);
    first = first == nullptr && fits ? item : first;
  }
  if (list_->currentItem() == nullptr || list_->currentItem()->isHidden()) {
    list_->setCurrentItem(first);
  }
  showChosen();
}

QAction* ShortcutsDialog::chosen() const {
  const QTreeWidgetItem* item = list_->currentItem();
  return item == nullptr ? nullptr : qobject_cast<QAction*>(item->data(actionColumn, Qt::UserRole).value<QObject*>());
}

void ShortcutsDialog::showChosen() {
  const QAction* action = chosen();
  const QSignalBlocker block(keys_);
  keys_->setKeySequence(action == nullptr ? QKeySequence() : action->shortcut());
  whose_->setText(action == nullptr ? QStringLiteral("No action selected")
                                    : QStringLiteral("&Keys of '%1'").arg(plainText(*action)));
  const QKeySequence defaultKeys = action == nullptr ? QKeySequence() : shortcuts_.defaultKeys(*action);
  keys_->setEnabled(action != nullptr);
  none_->setEnabled(action != nullptr && !action->shortcut().isEmpty());
  reset_->setEnabled(action != nullptr && action->shortcut() != defaultKeys);
  reset_->setToolTip(defaultKeys.isEmpty() ? QStringLiteral("The action has no default keys")
                                           : QStringLiteral("Resets the keys to %1").arg(shown(defaultKeys)));
  answer_->clear();
}

void ShortcutsDialog::take(const QKeyEvent& press) {
  const int key = press.key();
  const bool modifier = key == Qt::Key_Shift || key == Qt::Key_Control || key == Qt::Key_Alt || key == Qt::Key_Meta ||
                        key == Qt::Key_AltGr || key == Qt::Key_unknown;
  if (modifier || chosen() == nullptr) {
    return;
  }
  auto modifiers = press.modifiers() & ~Qt::KeypadModifier;
  const QString text = press.text();
  if (text.size() == 1 && text[0].isPrint() && !text[0].isLetter() && !text[0].isSpace()) {
    modifiers &= ~Qt::ShiftModifier;  // Shift was needed to type the character
  }
  showAnswer(shortcuts_.assign(*chosen(), QKeySequence(QKeyCombination(modifiers, Qt::Key(key)))));
}

void ShortcutsDialog::showAnswer(const QString& sentence) {
  showChosen();
  answer_->setText(sentence);
}

}  // namespace chainmail
