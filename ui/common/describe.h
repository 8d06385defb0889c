#pragma once

#include <QString>
#include <QWidget>

namespace chainmail {

/// Sets the name of a widget for tests, its name for screen readers, and its tooltip.
inline void describe(QWidget* widget, const char* name, const QString& accessible, const QString& help) {
  widget->setObjectName(QLatin1String(name));
  widget->setAccessibleName(accessible);
  widget->setToolTip(help);
}

}  // namespace chainmail
