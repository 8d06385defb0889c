#pragma once

namespace chainmail {

/// Adds Bullet's methods to the table of algorithms, for good: its soft body and, if asked for, its finite elements.
/// For programs that use the public interface: it includes nothing of core. No other thread may use the library
/// meanwhile.
void register_bullet(bool with_fem);

}  // namespace chainmail
