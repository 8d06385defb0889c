#pragma once

#include <QString>
#include <QStringList>

class QWidget;

namespace chainmail {

/// Asks for a file to save to. Proposes `name`, which has no extension, in the folder of the last save. The extension
/// follows the chosen filter. Returns an empty string if the user cancels.
QString askWhere(QWidget& window, const QString& title, const QStringList& filters, const QString& name);

/// Asks for a folder to save to, starting in that of the last save. Returns an empty string if the user cancels.
QString askFolder(QWidget& window, const QString& title);

/// Returns the name of an object as a file name without extension, such as 'Grid-30-20' for 'Grid 30 × 20'.
QString asFileName(const QString& object);

}  // namespace chainmail
