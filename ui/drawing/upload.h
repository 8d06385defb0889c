#pragma once

#include <QOpenGLBuffer>
#include <vector>

namespace chainmail {

/// Sends data to the graphics card; returns how many there are.
template <class Datum>
int upload(QOpenGLBuffer& buffer, const std::vector<Datum>& data) {
  buffer.bind();
  buffer.allocate(data.data(), int(data.size() * sizeof(Datum)));
  return int(data.size());
}

/// The same for a part of what the buffer already holds.
template <class Datum>
void uploadPart(QOpenGLBuffer& buffer, const std::vector<Datum>& data, std::size_t first, std::size_t end) {
  buffer.bind();
  buffer.write(int(first * sizeof(Datum)), data.data() + first, int((end - first) * sizeof(Datum)));
}

}  // namespace chainmail
