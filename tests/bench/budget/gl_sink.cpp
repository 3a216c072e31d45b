// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/budget/gl_sink.h"

#include <GLES3/gl3.h>

#include <cstring>
#include <vector>

namespace {

std::vector<char> taken;
uint64_t bytes_taken = 0;
GLuint last_name = 0;

void take(const void* data, std::size_t bytes) {
  if (data == nullptr) return;
  if (taken.size() < bytes) taken.resize(bytes);
  std::memcpy(taken.data(), data, bytes);
  bytes_taken += bytes;
}

std::size_t pixel_bytes(GLenum format, GLenum type) {
  const std::size_t channels = format == GL_RED ? 1 : format == GL_RGB ? 3 : 4;
  return channels * (type == GL_FLOAT ? sizeof(float) : 1);
}

void name_each(GLsizei n, GLuint* names) {
  for (GLsizei i = 0; i < n; ++i) names[i] = ++last_name;
}

}  // namespace

uint64_t nt::budget::gl_bytes_taken() { return bytes_taken; }

// What takes bytes.
void glBufferData(GLenum, GLsizeiptr size, const void* data, GLenum) { take(data, static_cast<std::size_t>(size)); }
void glBufferSubData(GLenum, GLintptr, GLsizeiptr size, const void* data) {
  take(data, static_cast<std::size_t>(size));
}
void glTexImage2D(GLenum, GLint, GLint, GLsizei width, GLsizei height, GLint, GLenum format, GLenum type,
                  const void* pixels) {
  take(pixels, static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * pixel_bytes(format, type));
}
void glTexSubImage2D(GLenum, GLint, GLint, GLint, GLsizei width, GLsizei height, GLenum format, GLenum type,
                     const void* pixels) {
  take(pixels, static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * pixel_bytes(format, type));
}

// What answers.
void glGenBuffers(GLsizei n, GLuint* names) { name_each(n, names); }
void glGenTextures(GLsizei n, GLuint* names) { name_each(n, names); }
void glGenVertexArrays(GLsizei n, GLuint* names) { name_each(n, names); }
GLuint glCreateShader(GLenum) { return ++last_name; }
GLuint glCreateProgram() { return ++last_name; }
void glGetShaderiv(GLuint, GLenum, GLint* value) { *value = GL_TRUE; }
void glGetProgramiv(GLuint, GLenum, GLint* value) { *value = GL_TRUE; }
void glGetIntegerv(GLenum, GLint* value) { *value = 4096; }
GLint glGetUniformLocation(GLuint, const GLchar*) { return 0; }
const GLubyte* glGetString(GLenum) { return nullptr; }
void* glMapBufferRange(GLenum, GLintptr, GLsizeiptr, GLbitfield) { return nullptr; }
GLboolean glUnmapBuffer(GLenum) { return GL_TRUE; }

// What would draw.
void glActiveTexture(GLenum) {}
void glAttachShader(GLuint, GLuint) {}
void glBeginTransformFeedback(GLenum) {}
void glBindBuffer(GLenum, GLuint) {}
void glBindBufferBase(GLenum, GLuint, GLuint) {}
void glBindTexture(GLenum, GLuint) {}
void glBindVertexArray(GLuint) {}
void glBlendFunc(GLenum, GLenum) {}
void glClear(GLbitfield) {}
void glClearColor(GLfloat, GLfloat, GLfloat, GLfloat) {}
void glCompileShader(GLuint) {}
void glDeleteBuffers(GLsizei, const GLuint*) {}
void glDeleteProgram(GLuint) {}
void glDeleteShader(GLuint) {}
void glDeleteTextures(GLsizei, const GLuint*) {}
void glDeleteVertexArrays(GLsizei, const GLuint*) {}
void glDisable(GLenum) {}
void glDrawArrays(GLenum, GLint, GLsizei) {}
void glDrawElements(GLenum, GLsizei, GLenum, const void*) {}
void glEnable(GLenum) {}
void glEnableVertexAttribArray(GLuint) {}
void glEndTransformFeedback() {}
void glGenerateMipmap(GLenum) {}
void glLinkProgram(GLuint) {}
void glPixelStorei(GLenum, GLint) {}
void glScissor(GLint, GLint, GLsizei, GLsizei) {}
void glShaderSource(GLuint, GLsizei, const GLchar* const*, const GLint*) {}
void glTexParameteri(GLenum, GLenum, GLint) {}
void glTransformFeedbackVaryings(GLuint, GLsizei, const GLchar* const*, GLenum) {}
void glUniform1f(GLint, GLfloat) {}
void glUniform1i(GLint, GLint) {}
void glUniform2f(GLint, GLfloat, GLfloat) {}
void glUniform4f(GLint, GLfloat, GLfloat, GLfloat, GLfloat) {}
void glUniform4fv(GLint, GLsizei, const GLfloat*) {}
void glUseProgram(GLuint) {}
void glVertexAttribIPointer(GLuint, GLint, GLenum, GLsizei, const void*) {}
void glVertexAttribPointer(GLuint, GLint, GLenum, GLboolean, GLsizei, const void*) {}
void glViewport(GLint, GLint, GLsizei, GLsizei) {}
