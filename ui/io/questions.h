#pragma once

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

}  // namespace chainmail
