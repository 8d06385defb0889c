#pragma once

#include <array>

#include "mesh/cuts.h"
#include "mesh/mesh.h"
#include "mesh/texture.h"
#include "solver/solver.h"

namespace chainmail {

/// Largest number of pixels in a picture that is read or made. Larger pictures are refused before memory is taken: a
/// pixel takes up to 12 bytes while the picture is decoded, even if the file is small.
inline constexpr double picture_limit = 100e6;

/// The part of the plane to draw: its lowest corner and its size, in whole texels from the first corner of the picture
/// of a sheet.
struct PictureFrame {
  std::array<double, 2> from{0, 0};
  std::array<double, 2> size{0, 0};
};
/// Returns the frame of the picture of a sheet.
PictureFrame own_frame(const Mesh& sheet);
/// Returns the frame around all whole triangles of a sheet at these positions.
PictureFrame frame_about(const Mesh& sheet, const Cuts& cuts, const PositionView& positions);

/// Returns the warped picture of a sheet (see is_sheet), with texels of the same size as in the original picture.
///
/// Each whole triangle maps its part of the picture by the affine map of its corners, with bilinear sampling. A pixel
/// belongs to the triangle that contains its centre. On a shared edge it belongs to only one of the two triangles, so
/// there are no seams. Pixels without a triangle, outside and in cuts, are transparent. Where the sheet is folded, the
/// later triangle is visible. A sheet at rest returns the exact picture: positions in single precision are off by less
/// than a thousandth of a pixel, which is less than half of one of 256 steps of brightness. Throws Error if the frame
/// has no pixels or more than picture_limit, and Cancelled.
Texture warped(const Mesh& sheet, const Cuts& cuts, const PositionView& positions, const PictureFrame& frame,
               const Progress& progress = {});

}  // namespace chainmail
