#include "window/lesson_editor.h"

#include <QAction>
#include <QEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QPlainTextEdit>
#include <QSignalBlocker>
#include <QToolButton>
#include <QVBoxLayout>

#include "common/icons.h"
#include "files/text/limits.h"

namespace chainmail {
namespace {

constexpr int captionLines = 3;

QLineEdit* makeField(const char* name, const QString& accessible, const QString& tip) {
  auto* field = new QLineEdit;
  field->setObjectName(QLatin1String(name));
  field->setAccessibleName(accessible);
  field->setToolTip(tip);
  field->setMaxLength(int(limits::name_bytes));
  return field;
}

/// Returns the beginning of a text that a file may have.
QString fitting(QString text, std::size_t bytes) {
  text.truncate(qsizetype(bytes));
  while (text.toUtf8().size() > qsizetype(bytes)) {
    text.chop(1);
  }
  return text;
}

/// Shows a text in a field, and leaves the cursor where it is if the text is there already.
void showIn(QLineEdit& field, const std::string& text) {
  const QString shown = QString::fromStdString(text);
  if (field.text() != shown) {
    const QSignalBlocker block(field);
    field.setText(shown);
  }
}

}  // namespace

LessonEditor::LessonEditor(Document& document, const LessonPlayer& player, std::function<LessonStep()> look)
    : player_(player),
      writer_(document),
      look_(std::move(look)),
      new_(add("lessonNew", QStringLiteral("New lesson &here"), "hints",
               QStringLiteral("Makes a lesson from the recorded moves, with its first step at the present position"))),
      edit_(add("lessonEdit", QStringLiteral("Ed&it lesson"), "file",
                QStringLiteral("Shows or hides fields and buttons that change the captions of the lesson"))),
      addStep_(add("lessonAddStep", QStringLiteral("&Add step here"), "plus",
                   QStringLiteral("Adds a step at the present position in the recorded moves"))),
      remove_(add("lessonRemoveStep", QStringLiteral("&Remove step"), "close",
                  QStringLiteral("Removes this step; the recorded moves stay"))),
      earlier_(add("lessonMoveEarlier", QStringLiteral("Move &earlier"), "stepBack",
                   QStringLiteral("Exchanges this caption with that of the step before"))),
      later_(add("lessonMoveLater", QStringLiteral("Move &later"), "stepForward",
                 QStringLiteral("Exchanges this caption with that of the step after"))),
      lessonTitle_(makeField("lessonTitleField", QStringLiteral("Title of the lesson"),
                             QStringLiteral("Title of the lesson, in bold before the title of the step"))),
      title_(
          makeField("lessonStepTitleField", QStringLiteral("Title of the step"), QStringLiteral("Title of this step"))),
      text_(new QPlainTextEdit) {
  setObjectName(QStringLiteral("lessonEditor"));
  edit_->setCheckable(true);
  arrange();
  listen();
  refresh();
}

QAction* LessonEditor::add(const char* name, const QString& text, const char* drawing, const QString& help) {
  auto* action = new QAction(text, this);
  action->setObjectName(QLatin1String(name));
  action->setIcon(icon(drawing));
  action->setStatusTip(help);
  action->setToolTip(help);
  return action;
}

void LessonEditor::arrange() {
  text_->setObjectName(QStringLiteral("lessonCaptionField"));
  text_->setAccessibleName(QStringLiteral("Caption of the step"));
  text_->setToolTip(QStringLiteral("Caption of this step. One to three short sentences fit well"));
  text_->setTabChangesFocus(true);
  text_->setFixedHeight((captionLines + 1) * text_->fontMetrics().lineSpacing());
  auto* titles = new QHBoxLayout;
  titles->addWidget(new QLabel(QStringLiteral("Lesson")));
  titles->addWidget(lessonTitle_, 1);
  titles->addWidget(new QLabel(QStringLiteral("Step")));
  titles->addWidget(title_, 1);
  auto* buttons = new QHBoxLayout;
  for (QAction* action : {addStep_, remove_, earlier_, later_}) {
    auto* button = new QToolButton;
    button->setDefaultAction(action);
    button->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    buttons->addWidget(button);
  }
  buttons->addStretch();
  auto* done = new QToolButton;
  done->setObjectName(QStringLiteral("lessonDone"));
  done->setText(QStringLiteral("Done"));
  done->setToolTip(QStringLiteral("Ends writing. Save the session to keep the lesson"));
  connect(done, &QToolButton::clicked, this, &LessonEditor::stop);
  buttons->addWidget(done);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->addLayout(titles);
  column->addWidget(text_);
  column->addLayout(buttons);
}

void LessonEditor::listen() {
  connect(new_, &QAction::triggered, this, &LessonEditor::begin);
  connect(edit_, &QAction::toggled, this, [this] {
    refresh();
    emit editingChanged();
  });
  connect(addStep_, &QAction::triggered, this, [this] { writer_.addStep(look_()); });
  connect(remove_, &QAction::triggered, this, [this] { writer_.removeStep(); });
  connect(earlier_, &QAction::triggered, this, [this] { writer_.moveStep(-1); });
  connect(later_, &QAction::triggered, this, [this] { writer_.moveStep(1); });
  connect(lessonTitle_, &QLineEdit::textEdited, this,
          [this](const QString& title) { writer_.setLessonTitle(fitting(title, limits::name_bytes).toStdString()); });
  connect(title_, &QLineEdit::textEdited, this,
          [this](const QString& title) { writer_.setTitle(fitting(title, limits::name_bytes).toStdString()); });
  connect(text_, &QPlainTextEdit::textChanged, this,
          [this] { writer_.setText(fitting(text_->toPlainText(), limits::caption_bytes).toStdString()); });
  for (QLineEdit* field : {lessonTitle_, title_}) {
    connect(field, &QLineEdit::editingFinished, this, &LessonEditor::refresh);
  }
  text_->installEventFilter(this);
  for (const auto change : {&LessonPlayer::openChanged, &LessonPlayer::stepChanged, &LessonPlayer::playsChanged}) {
    connect(&player_, change, this, &LessonEditor::refresh);
  }
}

/// A text that is empty gives way to the last one that is not, and of one that is too long the beginning stays.
bool LessonEditor::eventFilter(QObject* watched, QEvent* event) {
  if (watched == text_ && event->type() == QEvent::FocusOut) {
    refresh();
  }
  return QWidget::eventFilter(watched, event);
}

void LessonEditor::fill(QMenu& menu) { menu.addActions({new_, edit_, addStep_, remove_, earlier_, later_}); }

bool LessonEditor::isEditing() const { return edit_->isChecked(); }

void LessonEditor::stop() { edit_->setChecked(false); }

void LessonEditor::begin() {
  writer_.begin(look_());
  edit_->setChecked(true);
  text_->setFocus();
  text_->selectAll();
}

void LessonEditor::refresh() {
  if (!player_.isOpen()) {
    stop();
  }
  refreshActions();
  setVisible(isEditing());
  if (isEditing()) {
    showTexts();
  }
}

void LessonEditor::refreshActions() {
  const bool writes = isEditing() && !player_.plays();
  edit_->setEnabled(player_.isOpen());
  addStep_->setEnabled(writes);
  remove_->setEnabled(writes);
  earlier_->setEnabled(writes && player_.step() > 0);
  later_->setEnabled(writes && !player_.isLast());
  for (QWidget* field :
       {static_cast<QWidget*>(lessonTitle_), static_cast<QWidget*>(title_), static_cast<QWidget*>(text_)}) {
    field->setEnabled(!player_.plays());
  }
}

void LessonEditor::showTexts() {
  const LessonStep& step = player_.lesson().steps[player_.step()];
  showIn(*lessonTitle_, player_.lesson().title);
  showIn(*title_, step.title);
  const QString caption = QString::fromStdString(step.text);
  if (text_->toPlainText() != caption) {
    const QSignalBlocker block(text_);
    text_->setPlainText(caption);
  }
}

}  // namespace chainmail
