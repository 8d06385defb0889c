#include "files/formats/msh_types.h"

#include <algorithm>
#include <array>

namespace chainmail {
namespace {

constexpr MshType divided_type(int number, DividedKind kind) { return {number, corner_count(kind), kind}; }

}  // namespace

const MshType* msh_type(int number) {
  using enum DividedKind;
  static constexpr std::array types{
      MshType{msh_point, 1, {}},      MshType{msh_line, 2, {}},        MshType{msh_triangle, 3, {}},
      MshType{msh_quadrangle, 4, {}}, MshType{msh_tetrahedron, 4, {}}, MshType{msh_hexahedron, 8, {}},
      divided_type(6, prism),         divided_type(7, pyramid),        divided_type(8, line3),
      divided_type(9, triangle6),     divided_type(10, quadrangle9),   divided_type(11, tetrahedron10),
      divided_type(12, hexahedron27), divided_type(13, prism18),       divided_type(14, pyramid14),
      divided_type(16, quadrangle8),  divided_type(17, hexahedron20),  divided_type(18, prism15),
      divided_type(19, pyramid13)};
  const auto* const found =
      std::find_if(types.begin(), types.end(), [number](const MshType& type) { return type.number == number; });
  return found == types.end() ? nullptr : found;
}

}  // namespace chainmail
