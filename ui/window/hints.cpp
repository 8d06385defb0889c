#include "window/hints.h"

#include <QGridLayout>
#include <QLabel>
#include <QPushButton>
#include <QSettings>
#include <QVBoxLayout>

#include "common/colours.h"
#include "common/icons.h"

namespace chainmail {
namespace {

constexpr int iconSize = 20;  // pixels

QString seenKey() { return QStringLiteral("hintsSeen"); }

struct Hint {
  const char* icon;
  const char* words;
};
constexpr std::array hints{
    Hint{"drag", "<b>Drag</b> an element in any panel: all algorithms respond, side by side."},
    Hint{"fit", "The <b>wheel</b> zooms, the middle button pans, the right button turns; <b>F</b> fits the view."},
    Hint{"keyboard", "<b>F1</b> lists all actions and their keys; the tools on the left cut, pin and select."}};

}  // namespace

Hints::Hints() {
  setObjectName(QStringLiteral("hints"));
  setAccessibleName(QStringLiteral("Hints for the first start"));
  setFrameShape(QFrame::StyledPanel);
  setAutoFillBackground(true);
  auto* grid = new QGridLayout(this);
  grid->setContentsMargins(12, 6, 12, 6);
  grid->setHorizontalSpacing(10);
  for (int row = 0; row < int(hints.size()); ++row) {
    auto* sign = new QLabel;
    followTheme(*sign, [sign, name = hints[std::size_t(row)].icon] {
      sign->setPixmap(icon(name).pixmap({iconSize, iconSize}, sign->devicePixelRatioF()));
    });
    grid->addWidget(sign, row, 0);
    auto* words = new QLabel(QLatin1String(hints[std::size_t(row)].words));
    words->setTextFormat(Qt::RichText);
    words->setWordWrap(true);  // otherwise the hints would widen a small window
    grid->addWidget(words, row, 1);
  }
  auto* done = new QPushButton(QStringLiteral("Got it"));
  done->setObjectName(QStringLiteral("hintsDone"));
  done->setToolTip(QStringLiteral("Hides the hints (Esc). Help > Show hints shows them again"));
  grid->setColumnStretch(1, 1);
  auto* lesson = new QPushButton(QStringLiteral("Start a lesson"));
  lesson->setObjectName(QStringLiteral("hintsLesson"));
  lesson->setToolTip(QStringLiteral("Opens the first of six short lessons. Help > Lessons lists all"));
  auto* buttons = new QVBoxLayout;  // one above the other, so that the hints have room on a narrow screen
  buttons->addWidget(lesson);
  buttons->addWidget(done);
  grid->addLayout(buttons, 0, 2, int(hints.size()), 1, Qt::AlignVCenter);
  connect(done, &QPushButton::clicked, this, &QWidget::hide);
  connect(lesson, &QPushButton::clicked, this, &QWidget::hide);
  connect(lesson, &QPushButton::clicked, this, &Hints::lessonRequested);
  followTheme(*this, [this] {
    QPalette own;
    own.setColor(QPalette::Window, colours::infoGround);
    setPalette(own);
  });
  QFrame::setVisible(false);
}

bool Hints::seen() { return QSettings().value(seenKey()).toBool(); }

void Hints::present() {
  QSettings().setValue(seenKey(), true);
  aside_ = false;
  show();
}

void Hints::setAside(bool aside) {
  aside_ = aside;
  setVisible(wanted_);
}

void Hints::setVisible(bool visible) {
  wanted_ = visible;
  QFrame::setVisible(visible && !aside_);
}

}  // namespace chainmail
