#pragma once

#include <cstddef>
#include <initializer_list>
#include <span>
#include <vector>

#include "gui/render/gl_buffer.h"

namespace winslow::gui {

/// Vertices on the graphics card: rows of numbers, and which of them are which attribute.
class VertexRows {
 public:
  VertexRows() { glGenVertexArrays(1, &array_); }
  ~VertexRows() { glDeleteVertexArrays(1, &array_); }
  VertexRows(const VertexRows&) = delete;
  VertexRows& operator=(const VertexRows&) = delete;

  struct Column {
    GLint count;
    GLenum type;
    GLboolean normalised;
    std::size_t offset;
  };
  template <class Row>
  void upload(const std::vector<Row>& rows, std::initializer_list<Column> columns) {
    glBindVertexArray(array_);
    buffer_.upload(std::span<const Row>(rows));
    GLuint k = 0;
    for (const Column& c : columns) {
      glEnableVertexAttribArray(k);
      glVertexAttribPointer(k++, c.count, c.type, c.normalised, sizeof(Row),
                            reinterpret_cast<const void*>(c.offset));
    }
    glBindVertexArray(0);
    count_ = static_cast<GLsizei>(rows.size());
  }
  void draw(GLenum mode) const {
    glBindVertexArray(array_);
    glDrawArrays(mode, 0, count_);
    glBindVertexArray(0);
  }

 private:
  GLuint array_ = 0;
  GlBuffer buffer_{GL_ARRAY_BUFFER};
  GLsizei count_ = 0;
};

}  // namespace winslow::gui
