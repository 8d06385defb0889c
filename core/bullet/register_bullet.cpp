#include "bullet/register_bullet.h"

#include "bullet/soft_body.h"

namespace chainmail {

void register_bullet() { add_algorithm(bullet_soft_body()); }

}  // namespace chainmail
