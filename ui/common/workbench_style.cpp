#include "common/workbench_style.h"

#include <QLabel>
#include <QMainWindow>
#include <QPainter>
#include <QStyleOption>
#include <QTabBar>

#include "common/colours.h"
#include "common/icons.h"

namespace chainmail {
namespace {

constexpr double buttonRadius = 3;     // pixels, at a button's corners
constexpr float borderOpacity = 0.4F;  // of the border of a floating dock
constexpr int iconSpace = 4;           // pixels, beside the icon of a selector, as in Qt
constexpr int textMargin = 2;          // pixels, around the text of a selector, as in Qt
constexpr int extensionWidth = 24;     // pixels, of the button that opens the rest of a tool bar

}  // namespace

WorkbenchStyle::WorkbenchStyle() : QProxyStyle(QStringLiteral("Fusion")) {}

/// Qt shows a text as rich text if it looks like it, and rich text may name files, which Qt then reads. Labels get
/// texts from files: names, captions, errors. Tool tips and questions are shown by labels, too.
/// Tabs of docks take no focus: Qt moves a bar with one tab beyond the edge of the window but does not hide it.
void WorkbenchStyle::polish(QWidget* widget) {
  QProxyStyle::polish(widget);
  if (auto* label = qobject_cast<QLabel*>(widget); label != nullptr && label->textFormat() == Qt::AutoText) {
    label->setTextFormat(Qt::PlainText);
  }
  if (qobject_cast<QTabBar*>(widget) != nullptr && qobject_cast<QMainWindow*>(widget->parent()) != nullptr) {
    widget->setFocusPolicy(Qt::NoFocus);
  }
}

void WorkbenchStyle::drawPrimitive(PrimitiveElement element, const QStyleOption* option, QPainter* painter,
                                   const QWidget* widget) const {
  if (element == PE_FrameDockWidget) {
    QColor border = option->palette.color(QPalette::WindowText);
    border.setAlphaF(borderOpacity);
    painter->setPen(border);
    painter->drawRect(option->rect.adjusted(0, 0, -1, -1));
    return;
  }
  if (element != PE_PanelButtonTool || !option->state.testFlag(State_On)) {
    QProxyStyle::drawPrimitive(element, option, painter, widget);
    return;
  }
  painter->save();
  painter->setRenderHint(QPainter::Antialiasing);
  painter->setPen(QColor(colours::checkedEdge));
  painter->setBrush(QColor(colours::checked));
  painter->drawRoundedRect(QRectF(option->rect).adjusted(0.5, 0.5, -0.5, -0.5), buttonRadius, buttonRadius);
  painter->restore();
}

void WorkbenchStyle::drawControl(ControlElement element, const QStyleOption* option, QPainter* painter,
                                 const QWidget* widget) const {
  const auto* selector = qstyleoption_cast<const QStyleOptionComboBox*>(option);
  if (element == CE_ComboBoxLabel && selector != nullptr) {  // Qt cuts a long text in the middle of a letter
    QStyleOptionComboBox shortened = *selector;
    const int icon = selector->currentIcon.isNull() ? 0 : selector->iconSize.width() + iconSpace;
    const QRect field = subControlRect(CC_ComboBox, selector, SC_ComboBoxEditField, widget);
    shortened.currentText =
        selector->fontMetrics.elidedText(selector->currentText, Qt::ElideRight, field.width() - icon - textMargin);
    QProxyStyle::drawControl(element, &shortened, painter, widget);
    return;
  }
  if (element != CE_DockWidgetTitle) {
    QProxyStyle::drawControl(element, option, painter, widget);
    return;
  }
  painter->save();
  QFont bold = painter->font();
  bold.setBold(true);
  painter->setFont(bold);
  QProxyStyle::drawControl(element, option, painter, widget);
  painter->restore();
}

QIcon WorkbenchStyle::standardIcon(StandardPixmap picture, const QStyleOption* option, const QWidget* widget) const {
  switch (picture) {
    case SP_ToolBarHorizontalExtensionButton:
      return icon("more");
    case SP_TitleBarCloseButton:
      return icon("close");
    case SP_TitleBarNormalButton:
      return icon("float");
    default:
      return QProxyStyle::standardIcon(picture, option, widget);
  }
}

int WorkbenchStyle::pixelMetric(PixelMetric metric, const QStyleOption* option, const QWidget* widget) const {
  return metric == PM_ToolBarExtensionExtent ? extensionWidth : QProxyStyle::pixelMetric(metric, option, widget);
}

int WorkbenchStyle::styleHint(StyleHint hint, const QStyleOption* option, const QWidget* widget,
                              QStyleHintReturn* answer) const {
  return hint == SH_ComboBox_Popup ? 0 : QProxyStyle::styleHint(hint, option, widget, answer);
}

}  // namespace chainmail
