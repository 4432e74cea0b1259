#version 330 core
layout(location = 0) in vec2 position;
layout(location = 1) in vec2 texture_position;
layout(location = 2) in vec4 color;
uniform mat4 to_clip;
out vec2 fragment_texture_position;
out vec4 fragment_color;

void main() {
  fragment_texture_position = texture_position;
  fragment_color = color;
  gl_Position = to_clip * vec4(position, 0.0, 1.0);
}
