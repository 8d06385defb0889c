#include "common/write_bytes.h"

#include "common/as_path.h"
#include "files/text/outputs.h"

namespace chainmail {

void writeBytes(const QString& path, const QByteArray& bytes) {
  if (bytes.isEmpty()) {
    throw Error(path.toStdString(), "there is not enough memory for the picture", "choose a smaller scale");
  }
  write_file(asPath(path), [&](std::ostream& out) { out.write(bytes.constData(), bytes.size()); });
}

}  // namespace chainmail
