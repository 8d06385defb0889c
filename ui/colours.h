#pragma once

#include <QColor>

/// The few colours of the views, told apart by the colour-blind (Okabe and Ito 2008).
namespace chainmail::colours {

inline const QColor background(0x15, 0x19, 0x1f);
inline const QColor left(0xe6, 0x9f, 0x00);
inline const QColor right(0x56, 0xb4, 0xe9);
inline const QColor marked(0xff, 0xff, 0xff);
inline const QColor pinned(0xf0, 0xe4, 0x42);
inline const QColor selected(0xf5, 0xa6, 0xd0);
inline const QColor lit(0xf0, 0x50, 0x30);
inline const QColor inside(0x2f, 0xc4, 0x9b);  // a valid region
inline const QColor outside(0xf0, 0x7a, 0x30);

}  // namespace chainmail::colours
