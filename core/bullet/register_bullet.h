#pragma once

namespace chainmail {

/// Adds Bullet's soft body to the table of algorithms, for good. For programs that use the public interface: it
/// includes nothing of core. No other thread may use the library meanwhile.
void register_bullet();

}  // namespace chainmail
