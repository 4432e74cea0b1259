#version 330 core
uniform vec4 color;
uniform float width;
noperspective in vec2 along_across;
flat in float line_length;
flat in float opacity;
out vec4 pixel;

void main() {
  float beyond = max(max(-along_across.x, along_across.x - line_length), 0.0);
  float from_axis = length(vec2(beyond, along_across.y));
  float coverage = clamp(0.5 * max(width, 1.0) - from_axis + 0.5, 0.0, 1.0);
  pixel = vec4(color.rgb, color.a * opacity * coverage);
}
