#pragma once

#include <QString>

class QTableWidget;

namespace chainmail {

/// Returns the text of a table with its header, columns separated by tabs.
QString textOf(const QTableWidget& table);

/// Makes the copy keys copy the table to the clipboard while it has the keyboard focus.
void copyByKeys(QTableWidget& table);

}  // namespace chainmail
