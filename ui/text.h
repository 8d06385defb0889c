#pragma once

#include <QString>
#include <string_view>

namespace chainmail {

/// A text of the core, for the window.
inline QString text(std::string_view view) { return QString::fromUtf8(view.data(), qsizetype(view.size())); }

}  // namespace chainmail
