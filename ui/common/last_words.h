#pragma once

namespace chainmail {

/// From now on, a program that has to end at once says so in one sentence on standard error: where the unsaved work is.
/// This is for what nothing can catch: a library that crashes when memory runs out, or an exception in a destructor.
/// Writes no file: automatic saving has written the work some seconds before. Handlers that others have set stay.
void prepareLastWords();

}  // namespace chainmail
