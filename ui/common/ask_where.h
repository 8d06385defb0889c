#pragma once

#include <QString>
#include <QStringList>

class QWidget;

namespace chainmail {

/// Asks where to save; a name without an ending gets that of the filter chosen. Empty where given up.
QString askWhere(QWidget& window, const QString& title, const QStringList& filters, const QString& folder);

}  // namespace chainmail
