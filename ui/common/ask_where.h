#pragma once

#include <QString>
#include <QStringList>

class QWidget;

namespace chainmail {

/// Asks for a file to save to. A name without an extension gets that of the chosen filter. Returns an empty string if
/// the user cancels.
QString askWhere(QWidget& window, const QString& title, const QStringList& filters, const QString& folder);

}  // namespace chainmail
