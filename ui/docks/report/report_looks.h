#pragma once

#include <QColor>
#include <QPixmap>

#include "report/run/compare.h"

namespace chainmail {

/// An algorithm's colour in plots, told apart by the colour-blind, as in the report's files.
QColor reportColour(Algorithm algorithm);

/// A contestant's name where room is short: all of them are ChainMail.
QString reportName(const report::Contestant& contestant);

/// A contestant's mark, as in the report's files: colour and shape are the algorithm's, hollow is with sweeps.
/// Square; `size` in logical pixels.
QPixmap reportMark(const report::Contestant& contestant, int size, double devicePixelRatio);

}  // namespace chainmail
