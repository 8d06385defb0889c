#pragma once

#include <QString>

class QTableWidget;

namespace chainmail {

/// A table as it stands, columns parted by tabs, under its heads.
QString textOf(const QTableWidget& table);

/// Lets the keys for copying put the table on the clipboard while it has the keyboard.
void copyByKeys(QTableWidget& table);

}  // namespace chainmail
