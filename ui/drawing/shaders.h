#pragma once

#include <QOpenGLShaderProgram>

namespace chainmail {

/// Compiles a program from two files of resources/shaders. `head` follows the version line, for example definitions.
/// Throws Error with the driver's log if they do not compile.
void buildProgram(QOpenGLShaderProgram& program, const char* vertex, const char* fragment, const QByteArray& head = {});

}  // namespace chainmail
