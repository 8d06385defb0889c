#pragma once

#include <QString>
#include <cstddef>

class QWidget;

namespace chainmail {

// Questions that protect the user's work.

enum class ClosingAnswer { saveAs, discard, cancel };

/// Asks what to do with unsaved work that cannot be kept when the window closes. `why` is the sentence that says so.
ClosingAnswer askBeforeClosing(QWidget& window, const QString& why);

enum class OverwriteAnswer { overwrite, saveAs, cancel };

/// Asks before a session overwrites a file that another program has changed.
OverwriteAnswer askBeforeOverwriting(QWidget& window, const QString& path);

/// Asks whether a file that cannot be replaced as a whole is written in place. `why` is the sentence that says so.
OverwriteAnswer askToWriteInPlace(QWidget& window, const QString& path, const QString& why);

}  // namespace chainmail
