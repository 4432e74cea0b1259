#version 330 core
in vec2 fragment_texture_position;
in vec4 fragment_color;
uniform sampler2D glyphs;
out vec4 pixel;

void main() {
  pixel = fragment_color * texture(glyphs, fragment_texture_position);
}
