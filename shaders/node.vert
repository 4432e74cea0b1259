#version 330 core
layout(location = 0) in vec2 position;
layout(location = 2) in float height;   // 0 where the mesh is plane
layout(location = 1) in float spacing;  // shortest edge at the node; 0: this vertex is no node
uniform mat4 to_clip;
uniform float size;  // pixels
uniform float pixels_per_unit;
flat out float opacity;

void main() {
  opacity = clamp(spacing * pixels_per_unit / (2.0 * size), 0.0, 1.0);
  gl_PointSize = size + 1.0;
  gl_Position = opacity > 0.004 ? to_clip * vec4(position, height, 1.0) : vec4(2.0, 2.0, 2.0, 1.0);
}
