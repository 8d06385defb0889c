#pragma once

#include <QString>
#include <QStringList>
#include <cstddef>

class QWidget;

namespace chainmail {

// Questions that protect the user's work.

enum class ClosingAnswer { saveAs, discard, cancel };

/// Asks what to do with unsaved work that cannot be kept when the window closes or another object is opened. `why` is
/// the sentence that says so.
ClosingAnswer askBeforeClosing(QWidget& window, const QString& why);

enum class OverwriteAnswer { overwrite, saveAs, cancel };

/// Asks before a session overwrites a file that another program has changed.
OverwriteAnswer askBeforeOverwriting(QWidget& window, const QString& path);

/// Asks before files replace those in a folder that have the same names. Returns true for yes.
bool askBeforeReplacing(QWidget& window, const QString& folder, const QStringList& files);

// Questions for a place to save to.

/// Asks for a file to save to. Proposes `name`, which has no extension, in the folder of the last save. The extension
/// follows the chosen filter. Returns an empty string if the user cancels.
QString askWhere(QWidget& window, const QString& title, const QStringList& filters, const QString& name);

/// Asks for a folder to save to, starting in that of the last save. Returns an empty string if the user cancels.
QString askFolder(QWidget& window, const QString& title);

/// Returns the name of an object as a file name without extension, such as 'Grid-30-20' for 'Grid 30 × 20'.
QString asFileName(const QString& object);

}  // namespace chainmail
