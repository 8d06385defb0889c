// A panel in lines and words, for print.

#include <QPainter>
#include <QTextDocument>

#include "common/colours.h"
#include "common/panel_names.h"
#include "common/text.h"
#include "panels/panel.h"

namespace chainmail {
namespace {

constexpr int margin = 8;  // pixels, as of the panel's lines on the screen
const colours::Colour& ink = colours::marked;

/// Draws in a part of the panel, from that part's corner.
void drawAt(QPainter& painter, const QRect& part, const std::function<void()>& draw) {
  painter.save();
  painter.translate(part.topLeft());
  painter.setClipRect(QRect(QPoint(), part.size()));
  painter.setPen(QColor(ink));
  draw();
  painter.restore();
}

}  // namespace

void Panel::drawIn(QPainter& painter, const QColor& ground) {
  painter.fillRect(rect(), ground);
  painter.setFont(font());
  drawAt(painter, head_->geometry(), [&] { drawHead(painter); });
  if (legend_->isVisibleTo(this)) {
    drawAt(painter, legend_->geometry(), [&] { legend_->draw(painter); });
  }
  drawAt(painter, view_->geometry(), [&] { view_->drawIn(painter, ground); });
  drawAt(painter, statistics_->geometry(), [&] { drawStatistics(painter); });
}

/// Its letter, and its algorithm.
void Panel::drawHead(QPainter& painter) const {
  const QRect line = QRect(QPoint(), head_->size()).adjusted(margin, 0, -margin, 0);
  QFont bold = font();
  bold.setBold(true);
  painter.setFont(bold);
  painter.setPen(colours::ofPanel(panel_));
  QRect letter;
  painter.drawText(line, Qt::AlignLeft | Qt::AlignVCenter, panelName(panel_), &letter);
  painter.setFont(font());
  painter.setPen(QColor(ink));
  painter.drawText(line.adjusted(letter.width() + margin, 0, 0, 0), Qt::AlignLeft | Qt::AlignVCenter,
                   text(info(document_.algorithm(panel_)).label));
}

void Panel::drawStatistics(QPainter& painter) const {
  QTextDocument figures;
  figures.setDefaultFont(font());
  figures.setDocumentMargin(0);
  figures.setDefaultStyleSheet(QStringLiteral("p { color: %1 }").arg(QColor(ink).name()));
  figures.setHtml(QStringLiteral("<p>%1</p>").arg(statistics_->text()));
  figures.drawContents(&painter);
}

}  // namespace chainmail
