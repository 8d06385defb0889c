#include "io/repair_bar.h"

#include <QAccessible>
#include <QDoubleValidator>
#include <QHBoxLayout>
#include <QLineEdit>
#include <QPushButton>
#include <QToolButton>
#include <QVBoxLayout>

#include "common/colours.h"
#include "common/icons.h"
#include "common/text.h"
#include "files/repair/defects.h"
#include "mesh/mesh.h"

namespace chainmail {
namespace {

/// Returns phrases in which a line does not break.
QStringList withoutBreaks(const std::vector<std::string>& phrases) {
  QStringList whole;
  for (const std::string& phrase : phrases) {
    whole << text(phrase).replace(QLatin1Char(' '), QChar::Nbsp);
  }
  return whole;
}

QLabel* makeText(const char* name) {
  auto* label = new QLabel;
  label->setObjectName(QLatin1String(name));
  label->setTextFormat(Qt::PlainText);
  label->setWordWrap(true);
  return label;
}

}  // namespace

RepairBar::RepairBar() : row_(new QHBoxLayout(this)), text_(makeText("repairText")), shown_(makeText("repairShown")) {
  setObjectName(QStringLiteral("repairBar"));
  setFrameShape(QFrame::StyledPanel);
  setAutoFillBackground(true);
  auto* words = new QVBoxLayout;
  words->setSpacing(0);
  words->addWidget(text_);
  words->addWidget(shown_);
  row_->setContentsMargins(10, 4, 6, 4);
  row_->addLayout(words, 1);
  show_ = addButton(QStringLiteral("&Show"), "repairShow",
                    QStringLiteral("Selects the elements of one defect. Each click selects the next one"),
                    &RepairBar::showRequested);
  weld_ = addButton(QStringLiteral("&Weld"), "repairWeld",
                    QStringLiteral("Joins vertices that are as close as the distance beside this button, as one undo "
                                   "step. The object is then at rest, without cuts and pins"),
                    &RepairBar::weldRequested);
  addWeldDistance();
  loose_ = addButton(QStringLiteral("Remove loose &points"), "repairLoose",
                     QStringLiteral("Removes elements without links, as one undo step. The object is then at rest, "
                                    "without cuts and pins"),
                     &RepairBar::removeLooseRequested);
  holes_ = addButton(QStringLiteral("C&lose holes"), "repairHoles",
                     QStringLiteral("Closes the holes with triangles, as one undo step; all ids stay. The object is "
                                    "then at rest, without cuts and pins"),
                     &RepairBar::closeHolesRequested);
  cells_ =
      addButton(QStringLiteral("&Turn cells"), "repairCells",
                QStringLiteral("Turns cells that are inside out, as one undo step; all ids stay. Methods for cells "
                               "need this. The object is then at rest, without cuts and pins"),
                &RepairBar::turnCellsRequested);
  addClose();
  hide();
  followTheme(*this, [this] {
    QPalette own;
    own.setColor(QPalette::Window, colours::warningGround);
    setPalette(own);
  });
}

QPushButton* RepairBar::addButton(const QString& text, const char* name, const QString& help,
                                  void (RepairBar::*request)()) {
  auto* button = new QPushButton(text);
  button->setObjectName(QLatin1String(name));
  button->setToolTip(help);
  connect(button, &QPushButton::clicked, this, request);
  row_->addWidget(button);
  return button;
}

void RepairBar::addWeldDistance() {
  distance_ = new QLineEdit(QStringLiteral("0"));
  distance_->setObjectName(QStringLiteral("repairDistance"));
  distance_->setAccessibleName(QStringLiteral("Distance of welding, in mesh units"));
  distance_->setToolTip(
      QStringLiteral("Vertices as close as this are welded, in mesh units. 0 welds those at the same "
                     "position"));
  auto* validator = new QDoubleValidator(0, coordinate_limit, -1, distance_);
  validator->setNotation(QDoubleValidator::ScientificNotation);
  distance_->setValidator(validator);
  distance_->setFixedWidth(distance_->fontMetrics().horizontalAdvance(QStringLiteral("0.000000000")));
  connect(distance_, &QLineEdit::textChanged, weld_, [this] { weld_->setEnabled(distance_->hasAcceptableInput()); });
  connect(distance_, &QLineEdit::returnPressed, weld_, &QPushButton::click);
  row_->addWidget(new QLabel(QStringLiteral("within")));
  row_->addWidget(distance_);
}

void RepairBar::addClose() {
  auto* close = new QToolButton;
  close->setObjectName(QStringLiteral("repairClose"));
  close->setIcon(icon("close"));
  close->setAutoRaise(true);
  close->setToolTip(QStringLiteral("Closes this bar; Object > Repair shows it again"));
  close->setAccessibleName(QStringLiteral("Close the bar of repairs"));
  connect(close, &QToolButton::clicked, this, &RepairBar::dismissed);
  row_->addWidget(close);
}

double RepairBar::weldDistance() const { return distance_->locale().toDouble(distance_->text()); }

void RepairBar::offer(const Defects& defects, const QString& ifNone) {
  const bool isSound = defects.empty();
  text_->setText(isSound ? ifNone : withoutBreaks(in_words(defects)).join(QStringLiteral(" · ")));
  setAccessibleName(isSound ? text_->text() : QStringLiteral("Defects: %1").arg(text_->text()));
  show_->setVisible(!isSound);
  loose_->setVisible(!defects.loose.empty());
  holes_->setVisible(!defects.holes.empty());
  cells_->setVisible(!defects.inverted.empty());
  showShown({});
  show();
  QAccessibleEvent alert(this, QAccessible::Alert);
  QAccessible::updateAccessibility(&alert);
}

void RepairBar::showShown(const QString& what) {
  shown_->setText(what);
  shown_->setVisible(!what.isEmpty());
}

}  // namespace chainmail
