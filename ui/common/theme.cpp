#include "common/theme.h"

#include <QLabel>
#include <QMainWindow>
#include <QPainter>
#include <QSettings>
#include <QStyleOption>
#include <QTabBar>

#include "common/icons.h"

namespace chainmail {
namespace {

using colours::Colour;
using colours::Ground;

QString themeKey() { return QStringLiteral("theme"); }
QString lightName() { return QStringLiteral("light"); }

struct Role {
  QPalette::ColorRole role;
  Colour colour;
};

constexpr Colour boxGround(0xff6e7783, 0xffffffff), boxEdge(0xff6e7783, 0xff9aa1ab),
    listBoxEdge(0xffb4bcc8, 0xff9aa1ab);
constexpr Colour faintText(0xff98a0ab, 0xff59616c);

constexpr std::array roles{Role{QPalette::Window, {0xff242930, 0xffeceef1}},
                           Role{QPalette::WindowText, {0xffe4e7eb, 0xff1a1e24}},
                           Role{QPalette::Base, {0xff1b1f25, 0xffffffff}},
                           Role{QPalette::AlternateBase, {0xff242930, 0xfff3f5f7}},
                           Role{QPalette::ToolTipBase, {0xff1b1f25, 0xffffffff}},
                           Role{QPalette::ToolTipText, {0xffe4e7eb, 0xff1a1e24}},
                           Role{QPalette::PlaceholderText, faintText},
                           Role{QPalette::Text, {0xffe4e7eb, 0xff1a1e24}},
                           Role{QPalette::Button, {0xff30363f, 0xffe2e5e9}},
                           Role{QPalette::ButtonText, {0xffe4e7eb, 0xff1a1e24}},
                           Role{QPalette::BrightText, {0xffffffff, 0xffffffff}},
                           Role{QPalette::Light, {0xff464e59, 0xffffffff}},
                           Role{QPalette::Midlight, {0xff3a414b, 0xffd4d8de}},
                           Role{QPalette::Mid, {0xff3a414b, 0xffc2c7ce}},
                           Role{QPalette::Dark, {0xff14171c, 0xff9aa1ab}},
                           Role{QPalette::Shadow, {0xff0c0e11, 0xff6b727c}},
                           Role{QPalette::Highlight, {0xff2a78ad, 0xffa9d2ee}},
                           Role{QPalette::HighlightedText, {0xffffffff, 0xff1a1e24}},
                           Role{QPalette::Link, {0xff56b4e9, 0xff0068a8}},
                           Role{QPalette::LinkVisited, {0xffc9a0e8, 0xff6b3fa0}}};

constexpr double buttonRadius = 3;     // pixels, at a button's corners
constexpr float borderOpacity = 0.4F;  // of the border of a floating dock
constexpr int iconSpace = 4;           // pixels, beside the icon of a selector, as in Qt
constexpr int textMargin = 2;          // pixels, around the text of a selector, as in Qt
constexpr int extensionWidth = 24;     // pixels, of the button that opens the rest of a tool bar

}  // namespace

QPalette paletteOn(Ground ground) {
  QPalette palette;
  for (const Role& one : roles) {
    palette.setColor(one.role, one.colour.on(ground));
  }
  for (const auto role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText}) {
    palette.setColor(QPalette::Disabled, role, faintText.on(ground));
  }
  return palette;
}

Ground rememberedGround() {
  return QSettings().value(themeKey()).toString() == lightName() ? Ground::light : Ground::dark;
}

void remember(Ground ground) {
  QSettings().setValue(themeKey(), ground == Ground::dark ? QStringLiteral("dark") : lightName());
}

void applyGround(Ground ground) {
  QApplication::setPalette(paletteOn(ground));
  // Fusion draws an empty check box with the edge of all frames, which is too faint.
  QPalette boxes = paletteOn(ground);
  boxes.setColor(QPalette::Base, boxGround.on(ground));
  boxes.setColor(QPalette::Window, boxEdge.on(ground));
  QApplication::setPalette(boxes, "QCheckBox");
  // In lists, the edge of check boxes has the Window colour; their background is that of the text.
  QPalette lists = paletteOn(ground);
  lists.setColor(QPalette::Window, listBoxEdge.on(ground));
  QApplication::setPalette(lists, "QListWidget");
  // In menus, a checked item with an icon is drawn as a pressed button.
  QPalette menus = lists;
  menus.setColor(QPalette::Button, colours::checked.on(ground));
  QApplication::setPalette(menus, "QMenu");
}

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
