#include "drawing/shaders.h"

#include <QFile>

#include "mesh/error.h"

namespace chainmail {

void buildProgram(QOpenGLShaderProgram& program, const char* vertex, const char* fragment, const QByteArray& head) {
  const auto source = [&head](const char* name) {
    QFile file(QLatin1String(":/shaders/") + QLatin1String(name));
    return file.open(QIODevice::ReadOnly) ? "#version 330 core\n" + head + file.readAll() : QByteArray();
  };
  if (!(program.addShaderFromSourceCode(QOpenGLShader::Vertex, source(vertex)) &&
        program.addShaderFromSourceCode(QOpenGLShader::Fragment, source(fragment)) && program.link())) {
    throw Error("OpenGL", program.log().simplified().toStdString(), "update the graphics driver");
  }
}

}  // namespace chainmail
