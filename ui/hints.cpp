#include "hints.h"

#include <QEvent>
#include <QGridLayout>
#include <QLabel>
#include <QPushButton>
#include <QSettings>

#include "colours.h"
#include "icons.h"

namespace chainmail {
namespace {

constexpr int iconSize = 20,
              distance = 62;  // pixels; the distance is that to the panels' lower edge, below their figures

QString seenKey() { return QStringLiteral("hintsSeen"); }

struct Hint {
  const char* icon;
  const char* words;
};
constexpr std::array hints{
    Hint{"drag", "<b>Drag</b> an element in either panel: both algorithms answer, side by side."},
    Hint{"fit", "The <b>wheel</b> zooms, the middle button shifts, the right one turns; <b>F</b> shows all again."},
    Hint{"keyboard", "<b>F1</b> lists every action and its keys; the tools on the left cut, pin and select."}};

}  // namespace

Hints::Hints(QWidget& over) : QFrame(&over) {
  setObjectName(QStringLiteral("hints"));
  setAccessibleName(QStringLiteral("Hints for the start"));
  setFrameShape(QFrame::StyledPanel);
  setAutoFillBackground(true);
  setBackgroundRole(QPalette::ToolTipBase);
  auto* grid = new QGridLayout(this);
  grid->setContentsMargins(14, 10, 14, 10);
  grid->setHorizontalSpacing(10);
  for (int row = 0; row < int(hints.size()); ++row) {
    auto* sign = new QLabel;
    followTheme(*sign, [sign, name = hints[std::size_t(row)].icon] {
      sign->setPixmap(icon(name).pixmap({iconSize, iconSize}, sign->devicePixelRatioF()));
    });
    grid->addWidget(sign, row, 0);
    grid->addWidget(new QLabel(QLatin1String(hints[std::size_t(row)].words)), row, 1);
  }
  auto* done = new QPushButton(QStringLiteral("Got it"));
  done->setObjectName(QStringLiteral("hintsDone"));
  done->setToolTip(QStringLiteral("Takes the hints away (Esc); Help > Show the hints again brings them back"));
  grid->addWidget(done, 0, 2, int(hints.size()), 1, Qt::AlignVCenter);
  connect(done, &QPushButton::clicked, this, &QWidget::hide);
  over.installEventFilter(this);
  hide();
}

bool Hints::seen() { return QSettings().value(seenKey()).toBool(); }

void Hints::present() {
  QSettings().setValue(seenKey(), true);
  show();
  place();
}

bool Hints::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::Resize && isVisible()) {
    place();
  }
  return QFrame::eventFilter(watched, event);
}

void Hints::place() {
  const QSize size = sizeHint().boundedTo(parentWidget()->size());
  setGeometry((parentWidget()->width() - size.width()) / 2, parentWidget()->height() - size.height() - distance,
              size.width(), size.height());
  raise();
}

}  // namespace chainmail
