#pragma once

#include <QString>

#include "files/session/session.h"
#include "mesh/progress.h"

namespace chainmail {

/// Files of unsaved work, which all running programs of a user keep in one folder. Work is a session `ID.chainmail`, or
/// `ID.closed.chainmail` from a closed window. Its object may be in a file of its own, `ID.object-N`, so that saving
/// again writes only what the user has changed. A lock beside the session shows whether its program still runs.
namespace unsaved_work {

/// Returns the folder, and creates it if it does not exist.
QString folder();
/// Returns a path that no work has.
QString newPath();
/// Returns the path that work has after its window was closed.
QString closedPath(const QString& path);
/// True for work from a window that was closed, false for work from a crash.
bool isClosed(const QString& path);
/// Returns the path of the lock of work.
QString lockOf(const QString& path);
/// Returns the name of file `number` for the object of work.
QString objectName(const QString& path, int number);

/// Reads work with its object. Throws Error and Cancelled.
Session read(const QString& path, const Progress& progress = {});
/// Removes the files of the object except one.
void discardObjects(const QString& path, const QString& kept = {});
/// Removes work and its object.
void discard(const QString& path);
/// Removes the oldest work of closed windows.
void discardOldest();
/// Removes what crashes have left: unfinished files, locks, objects without work.
void discardLeftovers();

}  // namespace unsaved_work
}  // namespace chainmail
