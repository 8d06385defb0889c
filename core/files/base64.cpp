#include "files/base64.h"

namespace chainmail {

void Base64Writer::write_group(int characters) {
  static constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (int i = 0; i < 4; ++i) {
    text_ << (i < characters ? digits[group_ >> (18 - 6 * i) & 63] : '=');
  }
  group_ = 0;
  bytes_ = 0;
}

void Base64Writer::finish() {
  if (bytes_ != 0) {
    const int characters = bytes_ + 1;
    group_ <<= 8 * (3 - bytes_);
    write_group(characters);
  }
}

}  // namespace chainmail
