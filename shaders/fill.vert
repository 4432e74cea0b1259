#version 330 core
// Positions are relative to the draw list's origin; the matrix takes them to clip space.
layout(location = 0) in vec2 position;
uniform mat4 to_clip;

void main() {
  gl_Position = to_clip * vec4(position, 0.0, 1.0);
}
