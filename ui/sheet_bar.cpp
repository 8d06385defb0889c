#include "sheet_bar.h"

#include <QHBoxLayout>
#include <QKeyEvent>
#include <QLocale>
#include <QPushButton>
#include <algorithm>

#include "colours.h"
#include "mesh/sheet.h"

namespace chainmail {
namespace {

constexpr int mostAcross = 2000;  // four million elements of a square picture

std::array<std::uint32_t, 2> pixelsOf(QSize picture) {
  return {std::uint32_t(picture.width()), std::uint32_t(picture.height())};
}

}  // namespace

SheetBar::SheetBar() : text_(new QLabel), across_(new QSpinBox), result_(new QLabel) {
  setObjectName(QStringLiteral("sheetBar"));
  setFrameShape(QFrame::StyledPanel);
  setAutoFillBackground(true);
  text_->setObjectName(QStringLiteral("sheetPicture"));
  text_->setTextFormat(Qt::PlainText);
  text_->setWordWrap(true);
  result_->setObjectName(QStringLiteral("sheetSize"));
  across_->setObjectName(QStringLiteral("sheetAcross"));
  across_->setAccessibleName(QStringLiteral("Elements across the picture"));
  across_->setToolTip(QStringLiteral("How many elements the sheet has along its width; its height follows"));
  connect(across_, &QSpinBox::valueChanged, this, &SheetBar::describe);
  arrange();
  hide();
  followTheme(*this, [this] {
    QPalette own;
    own.setColor(QPalette::Window, colours::infoGround);
    setPalette(own);
  });
}

void SheetBar::arrange() {
  auto* label = new QLabel(QStringLiteral("Elements &across"));
  label->setBuddy(across_);
  auto* open = new QPushButton(QStringLiteral("Open s&heet"));
  open->setObjectName(QStringLiteral("sheetOpen"));
  open->setToolTip(QStringLiteral("Opens the picture as a sheet in place of the present object, as a step of undo"));
  auto* leave = new QPushButton(QStringLiteral("&Cancel"));
  leave->setObjectName(QStringLiteral("sheetCancel"));
  leave->setToolTip(QStringLiteral("Does not open the picture; the object stays as it is"));
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(10, 4, 6, 4);
  row->addWidget(text_, 1);
  row->addWidget(label);
  row->addWidget(across_);
  row->addWidget(result_);
  row->addSpacing(8);
  row->addWidget(open);
  row->addWidget(leave);
  connect(open, &QPushButton::clicked, this, &SheetBar::answer);
  connect(leave, &QPushButton::clicked, this, &QWidget::hide);
}

void SheetBar::ask(const QString& name, QSize picture) {
  picture_ = picture;
  text_->setText(
      QStringLiteral("%1 as a sheet: %L2 × %L3 pixels").arg(name).arg(picture.width()).arg(picture.height()));
  across_->setRange(2, std::clamp(picture.width() + 1, 2, mostAcross));
  across_->setValue(standardAcross);
  describe();
  show();
  across_->setFocus();
  across_->selectAll();
}

void SheetBar::describe() {
  const auto [width, height] = sheet_size(pixelsOf(picture_), std::uint32_t(across_->value()));
  const double pixels = double(picture_.width()) / (width - 1);
  result_->setText(QStringLiteral("%L1 × %L2 elements, one every %3 pixels")
                       .arg(width)
                       .arg(height)
                       .arg(QLocale().toString(pixels, 'g', 4)));
}

void SheetBar::answer() {
  hide();
  emit answered(across_->value());
}

/// Escape is this bar's as long as it has the keyboard.
bool SheetBar::event(QEvent* event) {
  if (event->type() == QEvent::ShortcutOverride && static_cast<QKeyEvent*>(event)->key() == Qt::Key_Escape) {
    event->accept();
    return true;
  }
  return QFrame::event(event);
}

void SheetBar::keyPressEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Escape) {
    hide();
  } else if (event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter) {
    answer();
  } else {
    QFrame::keyPressEvent(event);
  }
}

}  // namespace chainmail
