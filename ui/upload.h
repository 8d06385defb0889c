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

}  // namespace chainmail
