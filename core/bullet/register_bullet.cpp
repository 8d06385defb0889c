#include "bullet/register_bullet.h"

#include "bullet/deformable_fem.h"
#include "bullet/soft_body.h"

namespace chainmail {

void register_bullet(bool with_fem) {
  add_algorithm(bullet_soft_body());
  if (with_fem) {
    add_algorithm(bullet_fem());
  }
}

}  // namespace chainmail
