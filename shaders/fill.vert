#version 330 core
// Positions are relative to the draw list's origin; the matrix takes them to clip space.
layout(location = 0) in vec2 position;
layout(location = 2) in float height;  // 0 where the mesh is plane
uniform mat4 to_clip;

void main() {
  gl_Position = to_clip * vec4(position, height, 1.0);
}
