#include "files/formats/msh_types.h"

#include <algorithm>
#include <array>

namespace chainmail {

const MshType* msh_type(int number) {
  using enum DividedKind;
  static constexpr std::array types{MshType{1, 2, {}},
                                    MshType{2, 3, {}},
                                    MshType{3, 4, {}},
                                    MshType{4, 4, {}},
                                    MshType{5, 8, {}},
                                    MshType{6, 6, prism},
                                    MshType{7, 5, pyramid},
                                    MshType{8, 3, line3},
                                    MshType{9, 6, triangle6},
                                    MshType{10, 9, quadrangle9},
                                    MshType{11, 10, tetrahedron10},
                                    MshType{12, 27, hexahedron27},
                                    MshType{13, 18, prism18},
                                    MshType{14, 14, pyramid14},
                                    MshType{15, 1, {}},
                                    MshType{16, 8, quadrangle8},
                                    MshType{17, 20, hexahedron20},
                                    MshType{18, 15, prism15},
                                    MshType{19, 13, pyramid13}};
  const auto* const found =
      std::find_if(types.begin(), types.end(), [number](const MshType& type) { return type.number == number; });
  return found == types.end() ? nullptr : found;
}

}  // namespace chainmail
