#pragma once

#include <array>

#include "mesh/cuts.h"
#include "mesh/mesh.h"
#include "mesh/texture.h"
#include "solve/solver.h"

namespace chainmail {

/// More pixels than this are refused before memory is taken, of pictures that are read and of those that are made: one
/// takes up to 12 bytes while it is decoded, whatever little its file may be.
inline constexpr double picture_limit = 100e6;

/// A part of the plane to make a picture of, in whole texels from the first corner of a sheet's picture: its lowest
/// corner and its size.
struct PictureFrame {
  std::array<double, 2> from{0, 0};
  std::array<double, 2> size{0, 0};
};
/// Of the picture as it was opened.
PictureFrame own_frame(const Mesh& sheet);
/// About all that is whole of a sheet as it stands.
PictureFrame frame_about(const Mesh& sheet, const Cuts& cuts, const PositionView& positions);

/// The picture of a sheet (see is_sheet) as it is warped, texel for texel as large as the one that it was made from.
///
/// Each whole triangle takes its part of the picture along, by the affine map of its corners, sampled bilinearly. A
/// pixel belongs to the triangle that its centre lies in, of two that share the edge through it to one: there are no
/// seams. What no triangle covers, outside and in cuts, is transparent; where the sheet is folded over itself, the
/// later triangle is seen. A sheet at rest gives the picture back to the bit: positions in single precision are off by
/// less than a thousandth of a pixel, which is less than half of one of 256 steps of brightness. Throws Error
/// where the frame has no pixels or more than picture_limit, and Cancelled.
Texture warped(const Mesh& sheet, const Cuts& cuts, const PositionView& positions, const PictureFrame& frame,
               const Progress& progress = {});

}  // namespace chainmail
